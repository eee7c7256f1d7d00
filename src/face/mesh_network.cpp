#include "face/mesh_network.h"

#include "face/landmark_sets.h"
#include "faceprobe/face/face.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::face {
namespace {

constexpr int kInputPx = 192;

}  // namespace

MeshNetwork::MeshNetwork(const std::filesystem::path& model) : model_(model, {1, kInputPx, kInputPx, 3}) {
  model_.output(3 * kMeshVertices);
  model_.output(1);
}

MeshReading MeshNetwork::read(const Sampler& photo, const SquareRegion& square) {
  photo.sample(square, kInputPx, 0.0F, 1.0F, model_.input().data());
  model_.run();
  const std::span<const float> raw = model_.output(3 * kMeshVertices);
  MeshReading reading;
  reading.score = 1.0F / (1.0F + std::exp(-model_.output(1)[0]));
  reading.landmarks_px.resize(kMeshVertices, 3);
  for (int i = 0; i < kMeshVertices; ++i) {
    const std::span<const float> point = raw.subspan(3 * static_cast<std::size_t>(i), 3);
    reading.landmarks_px.row(i).head<2>() = square.photo_from_unit(point[0] / kInputPx, point[1] / kInputPx).transpose();
    reading.landmarks_px(i, 2) = point[2] * square.side / kInputPx;  // depth is in the units of x
  }
  reading.landmarks_px.col(2).array() -= reading.landmarks_px.col(2).mean();
  return reading;
}

MeshReading MeshNetwork::read_refined(const Sampler& photo, const SquareRegion& square) {
  MeshReading first = read(photo, square);
  const SquareRegion again = mesh_region(first.landmarks_px);
  if (!first.landmarks_px.allFinite() || !(again.side > 0)) return first;
  return read(photo, again);
}

SquareRegion mesh_region(const Eigen::MatrixX3f& landmarks_px) {
  constexpr float kMargin = 1.5F;
  const Eigen::Vector2f eyes =
      (landmarks_px.row(kLeftEyeOuterCorner) - landmarks_px.row(kRightEyeOuterCorner)).head<2>().transpose();
  SquareRegion square;
  square.angle = std::atan2(eyes.y(), eyes.x());
  // The box is taken along the turned axes, so that a tilted head does not get a larger square.
  Eigen::Matrix2f turn;
  turn << std::cos(square.angle), std::sin(square.angle), -std::sin(square.angle), std::cos(square.angle);
  const Eigen::MatrixX2f turned = landmarks_px.leftCols<2>() * turn.transpose();
  const Eigen::RowVector2f low = turned.colwise().minCoeff();
  const Eigen::RowVector2f high = turned.colwise().maxCoeff();
  square.centre = turn.transpose() * (0.5F * (low + high)).transpose();
  square.side = kMargin * (high - low).maxCoeff();
  return square;
}

}  // namespace faceprobe::face
