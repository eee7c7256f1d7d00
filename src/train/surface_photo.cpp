#include "train/surface_photo.h"

#include "faceprobe/core/error.h"
#include "faceprobe/net/model_file.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "train/finetune_model.h"

#include <utility>

namespace faceprobe::train {
namespace {

constexpr double kLeastShown = 100;   // pixels of skin; a photo with less has no light to speak of
constexpr double kLeastShared = 200;  // pixels of the square that photos whose albedos are compared must share

// Where the network sees skin whose light can be used.
torch::Tensor probe_skin(const torch::Tensor& region_scores) {
  const torch::Tensor region = region_scores.argmax(1, true);
  torch::Tensor skin = torch::zeros_like(region, torch::kFloat);
  for (int r = 0; r < kRegionCount; ++r) {
    if (is_probe_skin(static_cast<Region>(r))) skin = skin + (region == r).to(torch::kFloat);
  }
  return skin;
}

}  // namespace

TrainConfig face_config_of(const std::filesystem::path& weights) {
  TrainConfig config = trained_config(weights);
  if (config.architecture != net::kFaceArchitecture) {
    throw Error(ExitCode::kInput, weights.string() + " holds the network \"" + config.architecture +
                                      "\", which sees no surface; give weights of a network face.");
  }
  return config;
}

Model face_model(const TrainConfig& config, const std::filesystem::path& weights) {
  Model model = make_model(config);
  net::load_weights(*model.module, weights);
  return model;
}

SurfaceLooker::SurfaceLooker(const Model& model, const TrainConfig& config, const std::filesystem::path& start)
    : model_(model), first_(face_model(config, start)) {
  view_.picture_px = config.picture_px;
  view_.multiple = std::dynamic_pointer_cast<net::UNetImpl>(model.module)->multiple();
  first_.module->eval();
}

std::vector<SurfacePhoto> SurfaceLooker::look(const PersonSet& set, const std::vector<int>& chosen) const {
  std::vector<SurfacePhoto> seen;
  for (const int number : chosen) {
    const auto i = static_cast<std::size_t>(number);
    SurfacePhoto one{view_of(*set.photos[i], set.masks[i], set.meshes[i], view_), {}, {}, {}, {}};
    const Batch batch = batch_of(one.view);
    {
      const torch::NoGradGuard no_gradients;
      const net::FaceSurface start = first_.surface(batch);
      one.start = photo_surface(start);
      one.skin = batch.skin * probe_skin(start.region);
      if (one.skin.sum().item<double>() < kLeastShown) continue;
      one.diffuse = batch.linear - model_.highlight(batch);
    }
    one.found = photo_surface(model_.surface(batch));
    seen.push_back(std::move(one));
  }
  return seen;
}

std::optional<torch::Tensor> albedos_apart(const std::vector<SurfacePhoto>& photos) {
  if (photos.size() < 2) return std::nullopt;
  constexpr double kWhole = 0.99;  // all four pixels are skin
  std::vector<torch::Tensor> diffuse, shading, weight;
  for (const SurfacePhoto& photo : photos) {
    diffuse.push_back(in_square(photo.diffuse, photo.view.warp));
    shading.push_back(in_square(photo.found.shading, photo.view.warp));
    weight.push_back((in_square(photo.skin, photo.view.warp) > kWhole).to(torch::kFloat));
  }
  const torch::Tensor weights = torch::cat(weight);
  if (weights.amin(0).sum().item<double>() < kLeastShared) return std::nullopt;
  return albedo_disagreement(torch::cat(diffuse), torch::cat(shading), weights);
}

}  // namespace faceprobe::train
