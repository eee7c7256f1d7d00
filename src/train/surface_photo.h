#pragma once
// Internal: photos of people as the face network that is being finetuned sees them, beside what it saw before.
//
//   const TrainConfig config = face_config_of(weights);
//   const Model model = face_model(config, weights);
//   const SurfaceLooker looker(model, config, weights);
//   for (const SurfacePhoto& photo : looker.look(person, {0, 2, 3})) ...

#include "faceprobe/train/config.h"
#include "faceprobe/train/people.h"
#include "train/model.h"
#include "train/photo_view.h"
#include "train/rerender_loss.h"

#include <torch/torch.h>
#include <filesystem>
#include <optional>
#include <vector>

namespace faceprobe::train {

// trained_config() (finetune_model.h) of weights that see a surface. Throws Error(kInput) for another architecture than "face", Error(kModel) for
// what are no weights.
TrainConfig face_config_of(const std::filesystem::path& weights);
Model face_model(const TrainConfig& config, const std::filesystem::path& weights);

struct SurfacePhoto {
  PhotoView view;         // whose memory the graph of `found` stands on
  PhotoSurface found;     // with a gradient, where those are on
  PhotoSurface start;     // by the first network, without
  torch::Tensor diffuse;  // 1 x 3 x H x W: the photo less its highlight, without a gradient
  torch::Tensor skin;  // 1 x 1 x H x W of 0 and 1: unclipped, on the mesh, and skin that can be used to the first network
};

class SurfaceLooker {
 public:
  // `model` must outlive it; `start`: the weights that it began with.
  SurfaceLooker(const Model& model, const TrainConfig& config, const std::filesystem::path& start);
  // Of the chosen photos those that show enough skin.
  std::vector<SurfacePhoto> look(const PersonSet& set, const std::vector<int>& chosen) const;

 private:
  const Model& model_;
  Model first_;
  ViewOptions view_;
};

// albedo_disagreement() of one person's photos; nothing when they share too little skin.
std::optional<torch::Tensor> albedos_apart(const std::vector<SurfacePhoto>& photos);

}  // namespace faceprobe::train
