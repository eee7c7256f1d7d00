#pragma once
// What a face detector says about one face, and how many sayings about the same face become one.

#include "face/sampler.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace faceprobe::face {

// Order of the detectors' keypoints; left and right are the subject's.
enum Keypoint : std::size_t { kRightEye, kLeftEye, kNoseTip, kMouthCentre, kRightEar, kLeftEar, kKeypointCount };

struct Detection {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  float width = 0, height = 0;
  std::array<Eigen::Vector2f, kKeypointCount> keypoints;
  float score = 0;
};

// Overlap of two boxes over their union, 0..1.
float intersection_over_union(const Detection& a, const Detection& b);

// Non-maximum suppression by averaging (Bazarevsky et al. 2019, BlazeFace, section 4): detections that overlap the best
// one by more than `overlap` are merged into it, weighted by score. The result is sorted by falling score.
constexpr float kMergeOverlap = 0.3F;
std::vector<Detection> merge_overlapping(std::vector<Detection> detections, float overlap);

// The square around a face, turned so that its eyes are level, as the mesh network wants it.
SquareRegion mesh_region(const Detection& detection);

}  // namespace faceprobe::face
