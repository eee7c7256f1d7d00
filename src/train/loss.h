#pragma once
// Internal: how far a highlight layer is from the one that is known.

#include "faceprobe/train/config.h"
#include "train/batch.h"

namespace faceprobe::train {

// A scalar with a gradient. Default: smoothed absolute error of light, of its square root and of its differences, weighed by skin;
// optionally with what the benchmark measures, each picture's root mean square and structural similarity on the skin.
// Paper (Sec. 3.1): mean squared error of light.
torch::Tensor highlight_loss(const torch::Tensor& highlight, const Batch& batch, const LossConfig& config);
torch::Tensor squared_loss(const torch::Tensor& highlight, const Batch& batch);

}  // namespace faceprobe::train
