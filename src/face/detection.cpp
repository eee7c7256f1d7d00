#include "face/detection.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::face {

float intersection_over_union(const Detection& a, const Detection& b) {
  const auto shared = [](float ca, float sa, float cb, float sb) {
    return std::max(0.0F, std::min(ca + sa / 2, cb + sb / 2) - std::max(ca - sa / 2, cb - sb / 2));
  };
  const float both =
      shared(a.centre.x(), a.width, b.centre.x(), b.width) * shared(a.centre.y(), a.height, b.centre.y(), b.height);
  const float either = a.width * a.height + b.width * b.height - both;
  return either > 0 ? both / either : 0.0F;
}

std::vector<Detection> merge_overlapping(std::vector<Detection> detections, float overlap) {
  std::ranges::stable_sort(detections, std::greater<>{}, &Detection::score);
  std::vector<Detection> merged;
  std::vector<bool> used(detections.size(), false);
  for (std::size_t best = 0; best < detections.size(); ++best) {
    if (used[best]) continue;
    Detection sum;
    sum.keypoints.fill(Eigen::Vector2f::Zero());  // Eigen leaves new vectors unset
    float weight = 0;
    for (std::size_t i = best; i < detections.size(); ++i) {
      const Detection& other = detections[i];
      if (used[i] || (i != best && intersection_over_union(detections[best], other) <= overlap)) continue;
      used[i] = true;
      weight += other.score;
      sum.centre += other.score * other.centre;
      sum.width += other.score * other.width;
      sum.height += other.score * other.height;
      for (std::size_t k = 0; k < kKeypointCount; ++k) sum.keypoints[k] += other.score * other.keypoints[k];
    }
    sum.centre /= weight;
    sum.width /= weight;
    sum.height /= weight;
    for (Eigen::Vector2f& keypoint : sum.keypoints) keypoint /= weight;
    sum.score = detections[best].score;
    merged.push_back(sum);
  }
  return merged;
}

SquareRegion mesh_region(const Detection& detection) {
  constexpr float kMargin = 1.5F;  // what the mesh network was trained with
  const Eigen::Vector2f eyes = detection.keypoints[kLeftEye] - detection.keypoints[kRightEye];
  return {detection.centre, kMargin * std::max(detection.width, detection.height), std::atan2(eyes.y(), eyes.x())};
}

}  // namespace faceprobe::face
