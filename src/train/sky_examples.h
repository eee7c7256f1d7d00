#pragma once
// Internal: parts of outdoor maps as a camera would photograph them, each with what a network should say of it.

#include "faceprobe/train/map_crops.h"
#include "faceprobe/train/train_sky.h"

#include <torch/torch.h>
#include <vector>

namespace faceprobe::train {

struct SkyExamples {
  torch::Tensor pictures;    // N x px x px x 3 bytes, sRGB
  torch::Tensor sun;         // N x 3: unit vector towards the sun, in the frame of a camera held level
  torch::Tensor numbers;     // N x net::kSkyNumbers
  double ground_albedo = 0;  // mean over maps

  std::int64_t count() const { return pictures.defined() ? pictures.size(0) : 0; }
};

// config.crops_per_map of each map, map by map; the same for the same config and `purpose`. Throws Error(kInput) for a map that has no light
// above its horizon.
SkyExamples draw_sky_examples(const std::vector<NamedMap>& maps, const SkyConfig& config, std::uint64_t purpose,
                              int threads);

// By what crop_of_map multiplied the map's radiance; 1 for a crop that is all black or clipped.
double gain_of_crop(const EnvMap& map, const MapCropOptions& view, const Image& crop);

}  // namespace faceprobe::train
