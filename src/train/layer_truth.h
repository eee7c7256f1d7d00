#pragma once
// Internal: the albedo and the shading that a batch's pictures were made of, for the networks that learn them by their product.

#include "train/batch.h"

#include <torch/torch.h>

namespace faceprobe::train {

// N x 3 x H x W each but `known`: N x 1 x H x W of 0 and 1, where the other two are known.
struct LayerTruth {
  torch::Tensor albedo, shading, known;
};
// albedo = (picture - highlight) / shading, at most 1, where there is light enough for that and nothing is clipped. `batch.surface` must be
// there.
LayerTruth layer_truth(const Batch& batch);

}  // namespace faceprobe::train
