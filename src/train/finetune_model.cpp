#include "train/finetune_model.h"

#include "faceprobe/core/error.h"
#include "faceprobe/net/model_file.h"

#include "net/torch/mscr.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "train/person_loss.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace faceprobe::train {
namespace {

constexpr const char* kRunKey = "run";  // of the weights' metadata: what they were trained by

// As large as `like`; what is beyond the picture is off the mesh.
Image padded_mesh(const Image& mesh, const Image& like) {
  Image padded(like.width(), like.height(), 3);
  for (int y = 0; y < mesh.height(); ++y) std::copy_n(mesh.pixel(0, y), mesh.row(y).size(), padded.pixel(0, y));
  return padded;
}

// One photo as a batch of its own.
Batch batch_of(Shown& shown) {
  Batch batch{net::tensor_view(shown.picture.linear),
              net::tensor_view(shown.picture.clip),
              net::tensor_view(shown.picture.mask),
              {},
              {}};
  batch.surface.mesh = net::tensor_view(shown.mesh);
  return batch;
}

int multiple_of(const Model& model) {
  const auto unet = std::dynamic_pointer_cast<net::UNetImpl>(model.module);
  return unet ? unet->multiple() : net::kMscrMultiple;
}

}  // namespace

TrainConfig trained_config(const std::filesystem::path& weights) {
  const net::ModelInfo info = net::read_model_info(weights);
  if (info.architecture != net::kUNetArchitecture && info.architecture != net::kFaceArchitecture &&
      info.architecture != net::kMscrArchitecture) {
    throw Error(ExitCode::kInput, weights.string() + " holds the network \"" + info.architecture +
                                      "\"; what is finetuned is unet, face and mscr.");
  }
  TrainConfig config;
  if (const auto run = info.metadata.find(kRunKey); run != info.metadata.end()) {
    const nlohmann::json json = nlohmann::json::parse(run->second, nullptr, false);
    if (json.is_object() && json.contains("config")) config = train_config_from_json(json["config"].dump());
  }
  config.architecture = info.architecture;
  config.network = info.options_json;
  config.precision = "float32";  // on the processor, whatever they were trained on
  return config;
}

Model load_model(const std::filesystem::path& weights) {
  Model model = make_model(trained_config(weights));
  net::load_weights(*model.module, weights);
  // So that what is finetuned can be finetuned again.
  const net::ModelInfo info = net::read_model_info(weights);
  if (const auto run = info.metadata.find(kRunKey); run != info.metadata.end()) model.metadata[kRunKey] = run->second;
  return model;
}

Shown show(const Model& model, const PersonSet& person, std::size_t i) {
  const PersonPhoto& photo = *person.photos[i];
  Shown shown{net::pad_picture(photo.linear, photo.clipped, person.masks[i], multiple_of(model)), {}, {}};
  shown.mesh = padded_mesh(person.meshes[i], shown.picture.linear);
  shown.highlight = model.forward(batch_of(shown));
  return shown;
}

Image layer_of(const Shown& shown, const Image& photo) {
  return net::crop_to_picture(shown.highlight.detach(), photo.width(), photo.height());
}

std::vector<Image> layers_of(const Model& model, const PersonSet& person, const std::vector<int>& chosen) {
  const torch::NoGradGuard no_gradients;
  std::vector<Image> layers;
  for (const int number : chosen) {
    const auto i = static_cast<std::size_t>(number);
    layers.push_back(layer_of(show(model, person, i), person.photos[i]->linear));
  }
  return layers;
}

torch::Tensor padded_gradient(const Image& gradient, const torch::Tensor& like) {
  Image copy = gradient;
  torch::Tensor whole = torch::zeros_like(like);
  whole.narrow(2, 0, gradient.height()).narrow(3, 0, gradient.width()).copy_(net::tensor_view(copy));
  return whole;
}

}  // namespace faceprobe::train
