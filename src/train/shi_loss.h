#pragma once
// Internal: what the network of Shi et al. 2017 (net/torch/shi.h) is trained on: all three layers of the picture, albedo and shading mostly up
// to a factor, because one picture does not tell which of the two is the brighter.

#include "net/torch/shi.h"
#include "train/batch.h"

#include <torch/torch.h>

namespace faceprobe::train {

// Mean square of scale * estimate - truth where `known`, with the best scale of each picture and channel, kept within 0.1 to 10.
torch::Tensor scale_invariant_error(const torch::Tensor& estimate, const torch::Tensor& truth,
                                    const torch::Tensor& known);

// A scalar with a gradient. Of albedo and shading 0.95 of the scale-invariant and 0.05 of the plain mean square, of the highlight the plain
// one, as released. That of the highlight is over the whole picture, as MSCR's is.
torch::Tensor shi_loss(const net::ShiLayers& found, const Batch& batch);

}  // namespace faceprobe::train
