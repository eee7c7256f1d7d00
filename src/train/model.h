#pragma once
// Internal: the network that is being trained, behind one call whatever its architecture.

#include "faceprobe/train/config.h"

#include "net/torch/face_head.h"
#include "train/batch.h"

#include <torch/torch.h>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace faceprobe::train {

// N x 3 x H x W each, linear, each at a level of its own.
struct FoundLayers {
  torch::Tensor albedo, shading;
};

struct Model {
  std::shared_ptr<torch::nn::Module> module;
  // For the loss: the layer as it comes. Bounded for the U-Net, raw for MSCR, which is trained on what it says (paper Sec. 3.1), and Shi.
  // Of albedo_shading its two layers of logarithms, one behind the other.
  std::function<torch::Tensor(const Batch&)> forward;
  // For use: within the picture, 0 <= H <= I. Empty for albedo_shading, which is given the picture without its highlights.
  std::function<torch::Tensor(const Batch&)> highlight;
  // What a step lowers.
  std::function<torch::Tensor(const Batch&, const LossConfig&)> loss;
  // Everything the face network finds but the highlights; empty for the others.
  std::function<net::FaceSurface(const Batch&)> surface;
  // What albedo_shading finds; empty for the others.
  std::function<FoundLayers(const Batch&)> layers;
  std::map<std::string, std::string> metadata;  // of the weights file
};

bool finds_surface(const TrainConfig& config);

// Throws Error(kUsage) for options that are not the architecture's own. Weights are drawn from torch's generator,
// and lie channels-last.
Model make_model(const TrainConfig& config);

}  // namespace faceprobe::train
