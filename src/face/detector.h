#pragma once
// BlazeFace (Bazarevsky et al. 2019): boxes and six keypoints from one square look at a photo.

#include "face/detection.h"
#include "face/sampler.h"
#include "face/tflite_model.h"

#include <filesystem>
#include <vector>

namespace faceprobe::face {

enum class DetectorKind {
  kShortRange,  // 128 px, fast; faces from about a fifth of the square
  kFullRange,   // 192 px, slower; faces from about a sixteenth
};

// Centres of the network's anchors in [0, 1]^2, in the order of its outputs: 896 for the short range, 2304 for the full
// one.
std::vector<Eigen::Vector2f> anchor_centres(DetectorKind kind);

class Detector {
 public:
  Detector(DetectorKind kind, const std::filesystem::path& model);

  // Faces inside a square of the photo, in photo px, those of score >= min_score, merged.
  std::vector<Detection> detect(const Sampler& photo, const SquareRegion& square, float min_score);

 private:
  int input_px_;
  std::vector<Eigen::Vector2f> anchors_;
  TfliteModel model_;
};

}  // namespace faceprobe::face
