#pragma once
// Internal: the network that finetuning starts with, and what it makes of a photo of a person.
//
//   const Model model = load_model("models/face.safetensors");
//   const Shown shown = show(model, person, 0);
//   shown.highlight.backward(padded_gradient(by_highlight, shown.highlight));

#include "faceprobe/train/config.h"
#include "faceprobe/train/people.h"

#include "net/padded_picture.h"
#include "train/model.h"

#include <torch/torch.h>
#include <filesystem>
#include <vector>

namespace faceprobe::train {

// As the weights were trained, so that what they know is kept by the loss they learnt it by. Throws Error(kInput) for architectures that
// are not finetuned.
TrainConfig trained_config(const std::filesystem::path& weights);
Model load_model(const std::filesystem::path& weights);

struct Shown {
  net::PaddedPicture picture;  // owns what the network's input is a view of
  Image mesh;                  // likewise
  torch::Tensor highlight;     // 1 x 3 x padded H x W, with its graph
};

// Photo number i of the person.
Shown show(const Model& model, const PersonSet& person, std::size_t i);
// Without the padding and the graph, as large as the photo; of several photos, without graphs from the start.
Image layer_of(const Shown& shown, const Image& photo);
std::vector<Image> layers_of(const Model& model, const PersonSet& person, const std::vector<int>& chosen);

// A gradient by the photo's layer as one by the padded tensor; nothing acts on the padding.
torch::Tensor padded_gradient(const Image& gradient, const torch::Tensor& like);

}  // namespace faceprobe::train
