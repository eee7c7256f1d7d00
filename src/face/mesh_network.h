#pragma once
// The dense mesh network (Kartynnik et al. 2019, Real-time facial surface geometry): 468 landmarks with relative depth
// from a square crop, and whether there is a face in it at all.

#include "face/sampler.h"
#include "face/tflite_model.h"

#include <Eigen/Core>
#include <filesystem>

namespace faceprobe::face {

struct MeshReading {
  Eigen::MatrixX3f landmarks_px;  // 468 x 3 as Face::landmarks_px
  float score = 0;                // that this is a face, 0..1
};

class MeshNetwork {
 public:
  explicit MeshNetwork(const std::filesystem::path& model);

  // One look at a square.
  MeshReading read(const Sampler& photo, const SquareRegion& square);
  // A look, then a second one centred by what the first saw: the crop the network was trained on is centred by
  // landmarks.
  MeshReading read_refined(const Sampler& photo, const SquareRegion& square);

 private:
  TfliteModel model_;
};

// The square around given landmarks, eyes level.
SquareRegion mesh_region(const Eigen::MatrixX3f& landmarks_px);

}  // namespace faceprobe::face
