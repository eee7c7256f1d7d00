#pragma once
// Internal: light at points all around, and how far it is from the true one as balls under it show it.

#include "faceprobe/train/train_regressor.h"

#include <torch/torch.h>

namespace faceprobe::train {

// Directions that light is known in.
struct LightPoints {
  torch::Tensor direction;    // M x 3, unit length
  torch::Tensor solid_angle;  // M, steradians
  torch::Tensor mirror;       // M: number of the point whose x is the other way, long

  std::int64_t count() const { return direction.size(0); }
};
LightPoints points_of_grid(int nside);
LightPoints points_of_panorama(int height);  // row after row

// K x M: means over lobes max(0, cosine)^exponent about K directions (K x 3). Rows sum to 1.
torch::Tensor lobe_rows(const torch::Tensor& about, const LightPoints& points, double exponent);

// Three balls under a light: diffuse, rough, and a mirror. In an orthographic picture of a mirror ball every solid angle has the same area, so a
// mean over points by solid angle is one over that picture.
class BallPictures {
 public:
  explicit BallPictures(const LightPoints& points);

  // LeGendre's loss, weighed together: absolute errors of what a camera would make of the diffuse and the rough ball, and of the logarithm
  // of the mirror's picture. N x M x 3, > 0.
  torch::Tensor loss(const torch::Tensor& found, const torch::Tensor& truth, const RegressorConfig& config) const;
  RegressorErrors errors(const torch::Tensor& found, const torch::Tensor& truth) const;  // no gradient
  torch::Tensor level(const torch::Tensor& light) const;  // N x 1 x 1: mean luminance of the diffuse ball's front

 private:
  torch::Tensor diffuse_rows_;  // normals of the front x M: irradiance over pi
  torch::Tensor rough_rows_;    // mirror directions x M
  torch::Tensor share_;         // M x 1: of the sphere
  torch::Tensor direction_;     // M x 3
};

}  // namespace faceprobe::train
