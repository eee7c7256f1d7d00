#include "pipeline/head_fit.h"

#include "face/landmark_sets.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "pipeline/unwrap_warp.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {
namespace {

constexpr int kFitRounds = 12;
constexpr double kLandmarkNoise = 0.02;       // of the face's width: how far the network's points stray
constexpr double kExpressionDeviation = 0.2;  // photos for skin are near neutral
constexpr double kMaxIdentity = 3.0;          // standard deviations
constexpr double kWarpSoftness = 0.03;

// Where the landmarks are on the neutral head, and how each parameter moves them: 3 #landmarks x #parameters.
struct LinearShape {
  Eigen::MatrixX3d base;
  Eigen::MatrixXd modes;
  int identities = 0;
};

LinearShape linear_shape(const synth::HeadModel& model, const LandmarkPairs& pairs) {
  const auto count = static_cast<Eigen::Index>(pairs.model.size());
  LinearShape shape;
  shape.identities = static_cast<int>(model.identity.size());
  shape.base.resize(count, 3);
  shape.modes =
      Eigen::MatrixXd::Zero(3 * count, static_cast<Eigen::Index>(model.identity.size() + model.expression.size()));
  for (Eigen::Index i = 0; i < count; ++i) {
    const synth::SurfacePoint& at = pairs.model[static_cast<std::size_t>(i)];
    shape.base.row(i) = surface_point(model.neutral, model.triangles, at).cast<double>().transpose();
    for (Eigen::Index mode = 0; mode < shape.modes.cols(); ++mode) {
      const Eigen::MatrixX3f& offsets = mode < shape.identities
                                            ? model.identity[static_cast<std::size_t>(mode)]
                                            : model.expression[static_cast<std::size_t>(mode - shape.identities)];
      for (int corner = 0; corner < 3; ++corner) {
        const int v = model.triangles(at.triangle, corner);
        if (v < offsets.rows()) {
          shape.modes.block<3, 1>(3 * i, mode) +=
              static_cast<double>(at.weights[corner]) * offsets.row(v).transpose().cast<double>();
        }
      }
    }
  }
  return shape;
}

struct Step {
  Eigen::MatrixXd jacobian;  // 2 #landmarks x (6 + modes)
  Eigen::VectorXd residual;
};

// Residuals and their derivatives by turn (about the camera's axes), shift and modes.
Step linearise(const LinearShape& shape, const Eigen::VectorXd& weights, const Eigen::Isometry3d& pose,
               const face::Camera& camera, const Eigen::MatrixX2d& wanted) {
  const Eigen::Index count = shape.base.rows();
  Step step{Eigen::MatrixXd(2 * count, 6 + shape.modes.cols()), Eigen::VectorXd(2 * count)};
  const Eigen::VectorXd offset = shape.modes * weights;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d turned = pose.linear() * (shape.base.row(i).transpose() + offset.segment<3>(3 * i));
    const Eigen::Vector3d p = turned + pose.translation();
    const double depth = std::max(1e-3, -p.z());
    Eigen::Matrix<double, 2, 3> project;  // derivative of x = cx + f X / d, y = cy - f Y / d with d = -Z
    project << 1, 0, p.x() / depth, 0, -1, -p.y() / depth;
    project *= camera.focal_px / depth;
    Eigen::Matrix3d turn;  // derivative of the point by a small turn
    turn << 0, turned.z(), -turned.y(), -turned.z(), 0, turned.x(), turned.y(), -turned.x(), 0;
    step.jacobian.block<2, 3>(2 * i, 0) = project * turn;
    step.jacobian.block<2, 3>(2 * i, 3) = project;
    step.jacobian.block(2 * i, 6, 2, shape.modes.cols()) = project * pose.linear() * shape.modes.middleRows<3>(3 * i);
    step.residual.segment<2>(2 * i) = wanted.row(i).transpose() - camera.project(p);
  }
  return step;
}

Eigen::Matrix3d turn_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

void add_modes(const std::vector<Eigen::MatrixX3f>& modes, const Eigen::VectorXf& weights, Eigen::MatrixX3f& vertices) {
  for (std::size_t i = 0; i < modes.size(); ++i)
    vertices.topRows(modes[i].rows()) += weights(static_cast<Eigen::Index>(i)) * modes[i];
}

}  // namespace

LandmarkPairs landmark_pairs(const synth::HeadModel& model) {
  LandmarkPairs pairs;
  if (model.dense_landmarks.size() == static_cast<std::size_t>(face::kMeshVertices)) {
    pairs.dense = true;
    pairs.model = model.dense_landmarks;
    for (int i = 0; i < face::kMeshVertices; ++i) pairs.mesh.push_back(i);
    return pairs;
  }
  if (model.landmarks.size() != 68) {
    throw Error(ExitCode::kModel, "The head model " + model.name +
                                      " has neither 468 dense landmarks nor 68; give one that does, or " +
                                      "let locate_dense_landmarks find them.");
  }
  std::vector<synth::SurfacePoint> at_vertex(static_cast<std::size_t>(model.neutral.rows()),
                                             synth::SurfacePoint{-1, {0, 0, 0}});
  for (int t = 0; t < model.triangles.rows(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      synth::SurfacePoint& at = at_vertex[static_cast<std::size_t>(model.triangles(t, corner))];
      if (at.triangle < 0) at = {t, Eigen::Vector3f::Unit(corner)};
    }
  }
  for (std::size_t i = 0; i < face::kIbugVertices.size(); ++i) {
    const auto vertex =
        static_cast<std::size_t>(model.landmarks[i + static_cast<std::size_t>(face::kFirstFixedIbugPoint)]);
    if (vertex >= at_vertex.size() || at_vertex[vertex].triangle < 0) continue;
    pairs.model.push_back(at_vertex[vertex]);
    pairs.mesh.push_back(face::kIbugVertices[i]);
  }
  if (pairs.model.size() < 20) {
    throw Error(ExitCode::kModel, "The 68 landmarks of the head model " + model.name + " do not lie on its surface.");
  }
  return pairs;
}

HeadFit fit_head(const synth::HeadModel& model, const LandmarkPairs& pairs, const face::Face& face,
                 const face::Camera& camera) {
  const LinearShape shape = linear_shape(model, pairs);
  const auto count = static_cast<Eigen::Index>(pairs.model.size());
  Eigen::MatrixX2d wanted(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    wanted.row(i) = face.landmarks_px.row(pairs.mesh[static_cast<std::size_t>(i)]).head<2>().cast<double>();
  }
  // The two frames have the same axes; the mean of the landmarks tells where this one's origin is.
  Eigen::Isometry3d pose = face.camera_from_face;
  const Eigen::Vector3d middle = shape.base.colwise().mean();
  Eigen::Vector3d middle_cam = Eigen::Vector3d::Zero();
  for (const int vertex : pairs.mesh) middle_cam += face.vertices_cam_m.row(vertex).transpose().cast<double>();
  pose.translation() = middle_cam / static_cast<double>(count) - pose.linear() * middle;

  const double noise_px = kLandmarkNoise * std::max(20.0, static_cast<double>(face.box.width));
  Eigen::VectorXd ridge(shape.modes.cols());
  for (Eigen::Index m = 0; m < ridge.size(); ++m) {
    const double deviation = m < shape.identities ? 1.0 : kExpressionDeviation;
    ridge(m) = noise_px * noise_px / (deviation * deviation);
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(shape.modes.cols());
  for (int round = 0; round < kFitRounds; ++round) {
    const Step step = linearise(shape, weights, pose, camera, wanted);
    // Pose alone first: it is what is farthest off.
    const Eigen::Index free = round < 3 ? 6 : step.jacobian.cols();
    const auto jacobian = step.jacobian.leftCols(free);
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    Eigen::VectorXd right = jacobian.transpose() * step.residual;
    normal.diagonal().array() *= 1.0 + 1e-9;
    if (free > 6) {
      normal.diagonal().tail(weights.size()) += ridge;
      right.tail(weights.size()) -= ridge.cwiseProduct(weights);
    }
    const Eigen::VectorXd change = normal.ldlt().solve(right);
    pose.linear() = turn_of(change.head<3>()) * pose.linear();
    pose.translation() += change.segment<3>(3);
    if (free > 6) weights += change.tail(weights.size());
    for (Eigen::Index m = 0; m < weights.size(); ++m) {
      weights(m) =
          m < shape.identities ? std::clamp(weights(m), -kMaxIdentity, kMaxIdentity) : std::clamp(weights(m), 0.0, 1.0);
    }
  }

  HeadFit fit;
  fit.camera_from_head = pose;
  fit.identity = weights.head(shape.identities).cast<float>();
  fit.expression = weights.tail(weights.size() - shape.identities).cast<float>();
  Eigen::MatrixX3f vertices = model.neutral;
  add_modes(model.identity, fit.identity, vertices);
  add_modes(model.expression, fit.expression, vertices);
  const Eigen::MatrixX3d turned = vertices.cast<double>() * pose.linear().transpose();
  fit.vertices_cam = (turned.rowwise() + pose.translation().transpose()).cast<float>();
  fit.landmarks_px.resize(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3f p = surface_point(fit.vertices_cam, model.triangles, pairs.model[static_cast<std::size_t>(i)]);
    fit.landmarks_px.row(i) = camera.project(p.cast<double>()).cast<float>().transpose();
  }
  fit.residual_px = std::sqrt((fit.landmarks_px.cast<double>() - wanted).rowwise().squaredNorm().mean());
  return fit;
}

Eigen::MatrixX3f picture_points(const HeadFit& fit, const LandmarkPairs& pairs, const face::Face& face,
                                const face::Camera& camera, const face::Crop& crop, int threads) {
  const auto to_crop = [&crop](const Eigen::Vector2d& px) -> Eigen::Vector2f {
    return crop.crop_from_photo(px.x(), px.y()).cast<float>();
  };
  const auto count = static_cast<Eigen::Index>(pairs.mesh.size());
  Eigen::MatrixX2f from(count, 2);
  Eigen::MatrixX2f to(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int vertex = pairs.mesh[static_cast<std::size_t>(i)];
    from.row(i) = to_crop(fit.landmarks_px.row(i).transpose().cast<double>()).transpose();
    to.row(i) = to_crop(face.landmarks_px.row(vertex).head<2>().transpose().cast<double>()).transpose();
  }
  const ThinPlateWarp warp(from, to, kWarpSoftness);
  Eigen::MatrixX3f points(fit.vertices_cam.rows(), 3);
  parallel_for(static_cast<int>(points.rows()), threads, [&](int first, int last) {
    for (int v = first; v < last; ++v) {
      const Eigen::Vector3d p = fit.vertices_cam.row(v).transpose().cast<double>();
      points.row(v).head<2>() = warp(to_crop(camera.project(p))).transpose();
      points(v, 2) = static_cast<float>(-p.z());
    }
  });
  return points;
}

}  // namespace faceprobe::pipeline
