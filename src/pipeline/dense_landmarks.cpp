#include "faceprobe/pipeline/dense_landmarks.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/vertex_normals.h"
#include "pipeline/unwrap_raster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace faceprobe::pipeline {
namespace {

constexpr int kSupersampling = 2;
constexpr float kHeadHeightM = 0.30F;  // that the picture shows, at the eyes
constexpr float kIrisRadiusM = 0.0058F;
const Eigen::Vector3f kSkin(0.45F, 0.30F, 0.22F);
const Eigen::Vector3f kBackground(0.30F, 0.30F, 0.30F);

struct Shot {
  face::Camera camera;
  Eigen::Isometry3d camera_from_head;
};

Shot shot_of(const DenseLandmarkOptions& options, int size_px, double yaw_deg, double pitch_deg) {
  Shot shot;
  shot.camera = {.focal_px = size_px * options.distance_m / static_cast<double>(kHeadHeightM),
                 .centre_x_px = 0.5 * size_px,
                 .centre_y_px = 0.5 * size_px};
  const Eigen::Vector3d middle(0, -0.02, 0);  // of the face, below the eyes
  shot.camera_from_head = Eigen::Translation3d(0, 0, -options.distance_m) *
                          Eigen::AngleAxisd(radians(-pitch_deg), Eigen::Vector3d::UnitX()) *
                          Eigen::AngleAxisd(radians(yaw_deg), Eigen::Vector3d::UnitY()) * Eigen::Translation3d(-middle);
  return shot;
}

// Pixel coordinates and depth of all vertices.
Eigen::MatrixX3f project_all(const Eigen::MatrixX3f& vertices, const Shot& shot) {
  Eigen::MatrixX3f points(vertices.rows(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::Vector3d p = shot.camera_from_head * vertices.row(v).transpose().cast<double>();
    points.row(v).head<2>() = shot.camera.project(p).cast<float>().transpose();
    points(v, 2) = static_cast<float>(-p.z());
  }
  return points;
}

std::vector<int> triangles_of(const synth::HeadModel& model, bool skin_only) {
  std::vector<int> chosen;
  for (int t = 0; t < model.triangles.rows(); ++t) {
    if (!skin_only || model.triangle_material[static_cast<std::size_t>(t)] == synth::Material::kSkin)
      chosen.push_back(t);
  }
  return chosen;
}

// Middles of the eyeballs, the subject's right first; empty without eyeballs.
std::vector<Eigen::Vector3f> eye_centres(const synth::HeadModel& model) {
  std::array<Eigen::Vector3f, 2> sum = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  std::array<int, 2> count = {0, 0};
  for (int t = 0; t < model.triangles.rows(); ++t) {
    if (model.triangle_material[static_cast<std::size_t>(t)] != synth::Material::kEye) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f p = model.neutral.row(model.triangles(t, corner)).transpose();
      const std::size_t side = p.x() > 0 ? 1 : 0;
      sum[side] += p;
      ++count[side];
    }
  }
  std::vector<Eigen::Vector3f> centres;
  for (std::size_t side = 0; side < 2; ++side) {
    if (count[side] > 0) centres.emplace_back(sum[side] / static_cast<float>(count[side]));
  }
  return centres;
}

Eigen::Vector3f plain_colour(Region region) {
  switch (region) {
    case Region::kBrows: return {0.05F, 0.035F, 0.03F};
    case Region::kLips: return {0.35F, 0.13F, 0.12F};
    case Region::kEyelids: return {0.32F, 0.20F, 0.16F};
    default: return kSkin;
  }
}

struct Paint {
  const synth::HeadModel& model;
  const ByteImage& texture;
  std::vector<Eigen::Vector3f> eyes;

  Eigen::Vector3f operator()(const RasterCell& cell) const {
    const Eigen::RowVector3i corners = model.triangles.row(cell.triangle);
    const Eigen::Vector3f p = (cell.weights.transpose() * model.neutral(corners, Eigen::all)).transpose();
    switch (model.triangle_material[static_cast<std::size_t>(cell.triangle)]) {
      case synth::Material::kEye: return eye(p);
      case synth::Material::kMouth: return {0.08F, 0.03F, 0.03F};
      case synth::Material::kTeeth: return {0.5F, 0.45F, 0.4F};
      default: break;
    }
    if (!texture.empty() && model.triangle_uv.rows() == model.triangles.rows()) {
      const Eigen::RowVector2f uv =
          cell.weights.transpose() * model.uv(model.triangle_uv.row(cell.triangle), Eigen::all);
      if (uv.minCoeff() >= 0 && uv.maxCoeff() <= 1) {
        const int x = std::min(texture.width() - 1, static_cast<int>(uv.x() * static_cast<float>(texture.width())));
        const int y =
            std::min(texture.height() - 1, static_cast<int>((1.0F - uv.y()) * static_cast<float>(texture.height())));
        const std::uint8_t* code = texture.pixel(x, y);
        return {linear_from_srgb(static_cast<float>(code[0]) / 255.0F),
                linear_from_srgb(static_cast<float>(code[1]) / 255.0F),
                linear_from_srgb(static_cast<float>(code[2]) / 255.0F)};
      }
    }
    if (model.vertex_region.size() != static_cast<std::size_t>(model.neutral.rows())) return kSkin;
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();
    for (int corner = 0; corner < 3; ++corner) {
      colour += cell.weights[corner] * plain_colour(model.vertex_region[static_cast<std::size_t>(corners[corner])]);
    }
    return colour;
  }

  // Looking straight ahead: dark iris, white around it.
  Eigen::Vector3f eye(const Eigen::Vector3f& p) const {
    float nearest = std::numeric_limits<float>::infinity();
    for (const Eigen::Vector3f& centre : eyes) nearest = std::min(nearest, (p - centre).head<2>().norm());
    if (nearest < 0.4F * kIrisRadiusM) return {0.01F, 0.01F, 0.01F};
    if (nearest < kIrisRadiusM) return {0.07F, 0.045F, 0.03F};
    return {0.6F, 0.55F, 0.52F};
  }
};

Eigen::Vector3f nearest_on_triangle(const Eigen::Matrix3f& corner, const Eigen::Vector3f& point) {
  // Weights of the nearest point; by regions of the triangle (Ericson 2005, "Real-time collision detection", 5.1.5).
  const Eigen::Vector3f a = corner.row(0).transpose();
  const Eigen::Vector3f ab = corner.row(1).transpose() - a;
  const Eigen::Vector3f ac = corner.row(2).transpose() - a;
  const float d1 = ab.dot(point - a);
  const float d2 = ac.dot(point - a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Eigen::Vector3f bp = point - corner.row(1).transpose();
  const float d3 = ab.dot(bp);
  const float d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Eigen::Vector3f cp = point - corner.row(2).transpose();
  const float d5 = ab.dot(cp);
  const float d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const float sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

synth::SurfacePoint nearest_skin(const synth::HeadModel& model, const std::vector<int>& skin,
                                 const Eigen::Vector3f& point) {
  synth::SurfacePoint best{skin.front(), {1, 0, 0}};
  float nearest = std::numeric_limits<float>::infinity();
  for (const int t : skin) {
    const Eigen::Matrix3f corner = model.neutral(model.triangles.row(t), Eigen::all);
    const Eigen::Vector3f weights = nearest_on_triangle(corner, point);
    const float distance = ((weights.transpose() * corner).transpose() - point).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      best = {t, weights};
    }
  }
  return best;
}

// Point of the skin seen at a pixel, head frame; where none is, the vertex of the visible skin that is nearest in the picture.
Eigen::Vector3f skin_under(const synth::HeadModel& model, const std::vector<int>& skin, const Eigen::MatrixX3f& points,
                           const Eigen::Vector2f& pixel) {
  float nearest_depth = std::numeric_limits<float>::infinity();
  Eigen::Vector3f found = Eigen::Vector3f::Zero();
  for (const int t : skin) {
    const Eigen::Matrix3f corner = points(model.triangles.row(t), Eigen::all);
    if ((corner.colwise().minCoeff().head<2>().array() > pixel.transpose().array()).any() ||
        (corner.colwise().maxCoeff().head<2>().array() < pixel.transpose().array()).any()) {
      continue;
    }
    Eigen::Vector3f weights;
    if (!plane_weights(corner.row(0).head<2>().transpose(), corner.row(1).head<2>().transpose(),
                       corner.row(2).head<2>().transpose(), pixel, weights) ||
        weights.minCoeff() < -1e-4F) {
      continue;
    }
    weights = weights.cwiseQuotient(corner.col(2));  // from the picture's plane to the surface
    weights /= weights.sum();
    const float depth = weights.dot(corner.col(2));
    if (depth >= nearest_depth) continue;
    nearest_depth = depth;
    found = (weights.transpose() * model.neutral(model.triangles.row(t), Eigen::all)).transpose();
  }
  if (std::isfinite(nearest_depth)) return found;
  float nearest = std::numeric_limits<float>::infinity();
  for (const int t : skin) {
    for (int corner = 0; corner < 3; ++corner) {
      const int v = model.triangles(t, corner);
      const float distance = (points.row(v).head<2>().transpose() - pixel).squaredNorm();
      if (distance >= nearest) continue;
      nearest = distance;
      found = model.neutral.row(v).transpose();
    }
  }
  return found;
}

}  // namespace

Image mannequin_picture(const synth::HeadModel& model, const DenseLandmarkOptions& options, double yaw_deg,
                        double pitch_deg) {
  const int side = kSupersampling * options.size_px;
  const Shot shot = shot_of(options, side, yaw_deg, pitch_deg);
  const Eigen::MatrixX3f points = project_all(model.neutral, shot);
  const MeshRaster raster = raster_mesh(points, model.triangles, triangles_of(model, false), side, side);
  const Eigen::MatrixX3f normals = vertex_normals(model.neutral, model.triangles);
  const Paint paint{model, options.texture.empty() ? model.texture : options.texture, eye_centres(model)};
  const Eigen::Vector3d lamp = Eigen::Vector3d(0.35, 0.55, 0.75).normalized();  // camera frame
  Image picture(options.size_px, options.size_px, 3);
  constexpr float kShare = 1.0F / (kSupersampling * kSupersampling);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const RasterCell& cell = raster.at(x, y);
      Eigen::Vector3f colour = kBackground;
      if (cell.triangle >= 0) {
        const Eigen::Vector3f normal =
            (cell.weights.transpose() * normals(model.triangles.row(cell.triangle), Eigen::all)).transpose();
        const Eigen::Vector3d normal_cam = shot.camera_from_head.linear() * normal.normalized().cast<double>();
        const double light = 0.45 + 0.15 * normal_cam.y() + 0.6 * std::max(0.0, normal_cam.dot(lamp));
        colour = static_cast<float>(light) * paint(cell);
      }
      Eigen::Map<Eigen::Vector3f>(picture.pixel(x / kSupersampling, y / kSupersampling)) += kShare * colour;
    }
  }
  return picture;
}

std::vector<synth::SurfacePoint> locate_dense_landmarks(const synth::HeadModel& model, const face::FaceFinder& finder,
                                                        const DenseLandmarkOptions& options) {
  const std::vector<int> skin = triangles_of(model, true);
  if (skin.empty())
    throw Error(ExitCode::kModel, "The head model " + model.name + " has no skin to find landmarks on.");
  // Yaw and pitch; pairs on both sides, so that what slides along an outline slides back.
  static constexpr std::array<std::array<double, 2>, 5> kViews = {{{0, 0}, {10, 0}, {-10, 0}, {0, 8}, {0, -8}}};
  Eigen::MatrixX3f sum = Eigen::MatrixX3f::Zero(face::kMeshVertices, 3);
  int views = 0;
  for (const auto& [yaw_deg, pitch_deg] : kViews) {
    const Shot shot = shot_of(options, options.size_px, yaw_deg, pitch_deg);
    const std::vector<face::Face> faces =
        finder.find(mannequin_picture(model, options, yaw_deg, pitch_deg), shot.camera);
    if (faces.empty()) continue;
    const auto largest = std::max_element(faces.begin(), faces.end(),
                                          [](const auto& a, const auto& b) { return a.box.width < b.box.width; });
    const Eigen::MatrixX3f points = project_all(model.neutral, shot);
    for (int i = 0; i < face::kMeshVertices; ++i) {
      sum.row(i) += skin_under(model, skin, points, largest->landmarks_px.row(i).head<2>().transpose()).transpose();
    }
    ++views;
  }
  if (views == 0) {
    throw Error(ExitCode::kModel, "The face finder sees no face in a picture of the head model " + model.name +
                                      "; give a skin texture in its UVs, or check that it is in metres and faces +z.");
  }
  std::vector<synth::SurfacePoint> out;
  out.reserve(face::kMeshVertices);
  for (int i = 0; i < face::kMeshVertices; ++i) {
    out.push_back(nearest_skin(model, skin, sum.row(i).transpose() / static_cast<float>(views)));
  }
  return out;
}

}  // namespace faceprobe::pipeline
