#pragma once
// Internal: how far lights are from the true ones, as balls under them show it.

#include "faceprobe/train/train_light.h"

#include <torch/torch.h>

namespace faceprobe::train {

class LightLoss {
 public:
  LightLoss();

  struct Terms {
    torch::Tensor diffuse, glossy;  // means over the lights
    torch::Tensor shape;  // the diffuse ball's again, each picture over its own brightest point, as the benchmark's object (light_metrics.h)
  };
  // N x cells x 3, > 0, of lighting::kFeatureNside, over one level for both.
  Terms terms(const torch::Tensor& found, const torch::Tensor& truth) const;

 private:
  torch::Tensor diffuse_rows_;  // normals of the front x cells: irradiance over pi
  torch::Tensor lobe_rows_;     // mirror directions x cells: mean over a lobe as wide as skin's
};

}  // namespace faceprobe::train
