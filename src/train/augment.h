#pragma once
// Internal: one sample as a network is given it, as it is or changed by chance.

#include "faceprobe/core/random.h"
#include "faceprobe/synth/shard.h"
#include "faceprobe/train/config.h"

namespace faceprobe::train {

// All of one size.
struct TrainingPicture {
  Image linear;     // 3 channels
  ByteImage clip;   // 3 channels of 0 and 1
  ByteImage mask;   // 1 channel
  Image highlight;  // 3 channels
  ByteImage skin;   // 1 channel
  // For the networks that learn from the surface or its shading: face, shi, albedo_shading; empty for the others.
  Image mesh = {};        // 3 channels: normals of the mesh that was found, 0 off it
  Image normal = {};      // 3 channels
  Image depth_m = {};     // 1 channel
  Image shading = {};     // 3 channels; 0 where it is not known
  Image open = {};        // 3 channels: open_shading.h; 0 where it is not known
  ByteImage region = {};  // 1 channel, Region

  bool has_surface() const { return !region.empty(); }
};

// As it is; of a config with a picture_px, the near view where there is one.
TrainingPicture plain_picture(const synth::ShardReader& reader, int sample, const TrainConfig& config);
// With the changes of `config.augment`. What the light does to both layers is done to both: gains scale them alike, a channel that
// passes white is clipped and marked, a thing in front has no highlight that is known, so it is matt.
TrainingPicture draw_picture(const synth::ShardReader& reader, int sample, const TrainConfig& config, Random& random);

// The change of one layer pair by a gain per channel.
void apply_gain(const std::array<float, 3>& gain, TrainingPicture& picture);

}  // namespace faceprobe::train
