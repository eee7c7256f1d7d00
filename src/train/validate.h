#pragma once
// Internal: how good a network is on samples it is not trained on, and what that looks like.

#include "faceprobe/train/train.h"
#include "train/model.h"

namespace faceprobe::train {

class Validator {
 public:
  // Takes up to config.validation_samples, spread evenly over the data set.
  Validator(const synth::ShardReader& reader, const TrainConfig& config, const torch::Device& device);
  Validation measure(const Model& model) const;
  // Rows of photo, highlight that is known, highlight that was found, what is left; the layers twice as bright as they are. Of the face
  // network, on skin, then the normals that are known and found, the shadings that are known and found, half as bright, and the albedo. Of
  // albedo_shading rows of photo, diffuse layer, shading that is known and that was found, half as bright, and the same of the albedo.
  ByteImage picture(const Model& model, int rows) const;

 private:
  std::vector<Batch> batches_;
};

}  // namespace faceprobe::train
