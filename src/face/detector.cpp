#include "face/detector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::face {
namespace {

constexpr std::size_t kRegressorValues = 4 + 2 * kKeypointCount;  // box centre and size, keypoints

int input_size(DetectorKind kind) { return kind == DetectorKind::kShortRange ? 128 : 192; }

// Anchors come as square grids, one after another, with several anchors on the same centre.
void append_grid(std::vector<Eigen::Vector2f>& centres, int cells, int per_cell) {
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const Eigen::Vector2f centre =
          (Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)).array() + 0.5F) / static_cast<float>(cells);
      centres.insert(centres.end(), static_cast<std::size_t>(per_cell), centre);
    }
  }
}

}  // namespace

std::vector<Eigen::Vector2f> anchor_centres(DetectorKind kind) {
  std::vector<Eigen::Vector2f> centres;
  if (kind == DetectorKind::kShortRange) {
    append_grid(centres, 16, 2);  // stride 8
    append_grid(centres, 8, 6);   // three layers of stride 16, two anchors each
  } else {
    append_grid(centres, 48, 1);  // stride 4
  }
  return centres;
}

Detector::Detector(DetectorKind kind, const std::filesystem::path& model)
    : input_px_(input_size(kind)), anchors_(anchor_centres(kind)),
      model_(model, {1, input_size(kind), input_size(kind), 3}) {
  model_.output(anchors_.size());
  model_.output(anchors_.size() * kRegressorValues);
}

std::vector<Detection> Detector::detect(const Sampler& photo, const SquareRegion& square, float min_score) {
  photo.sample(square, input_px_, -1.0F, 1.0F, model_.input().data());
  model_.run();
  const std::span<const float> logits = model_.output(anchors_.size());
  const std::span<const float> regressors = model_.output(anchors_.size() * kRegressorValues);

  std::vector<Detection> found;
  const float unit = 1.0F / static_cast<float>(input_px_);
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    const float score = 1.0F / (1.0F + std::exp(-std::clamp(logits[i], -100.0F, 100.0F)));
    if (score < min_score) continue;
    const std::span<const float> raw = regressors.subspan(i * kRegressorValues, kRegressorValues);
    const auto point = [&](std::size_t at) -> Eigen::Vector2f {  // offsets from the anchor are in input pixels
      return anchors_[i] + unit * Eigen::Vector2f(raw[at], raw[at + 1]);
    };
    Detection detection;
    detection.centre = point(0);
    detection.width = raw[2] * unit;
    detection.height = raw[3] * unit;
    if (!(detection.width > 0 && detection.height > 0)) continue;
    for (std::size_t k = 0; k < kKeypointCount; ++k) detection.keypoints[k] = point(4 + 2 * k);
    detection.score = score;
    found.push_back(detection);
  }

  found = merge_overlapping(std::move(found), kMergeOverlap);
  for (Detection& detection : found) {
    detection.centre = square.photo_from_unit(detection.centre.x(), detection.centre.y());
    detection.width *= square.side;
    detection.height *= square.side;
    for (Eigen::Vector2f& keypoint : detection.keypoints) {
      keypoint = square.photo_from_unit(keypoint.x(), keypoint.y());
    }
  }
  return found;
}

}  // namespace faceprobe::face
