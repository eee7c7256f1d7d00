#pragma once
// Internal: pictures and the light that was there, in memory.

#include "faceprobe/train/train_regressor.h"

#include <torch/torch.h>

namespace faceprobe::train {

struct RegressorExamples {
  torch::Tensor picture;  // N x px x px x 3, sRGB bytes
  torch::Tensor light;    // N x points x 3: radiance, where 1 is the picture's white; > 0

  std::int64_t count() const { return picture.defined() ? picture.size(0) : 0; }
};

// Crops of every map in turn: the camera turned anywhere about +y, a little up or down, its field of view and exposure by chance. `key` sets
// training and validation apart. Light on points_of_panorama(config.light_size).
RegressorExamples crop_examples(const std::vector<EnvMap>& maps, int count, std::uint64_t key,
                                const RegressorConfig& config, int threads);

// Faces spread evenly over a folder that `faceprobe synth` wrote, but for those that lamps in the room light and those that are not found. Light
// on points_of_grid(config.light_size). Throws Error(kInput): there are none.
RegressorExamples face_examples(const std::filesystem::path& folder, int most, const RegressorConfig& config,
                                int threads);

}  // namespace faceprobe::train
