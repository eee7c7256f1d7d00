#pragma once

#include "train/batch.h"

namespace faceprobe::train {

inline Batch to_device(const Batch& batch, const torch::Device& device) {
  if (device.is_cpu()) return batch;
  return {batch.linear.to(device), batch.clip.to(device), batch.mask.to(device), batch.highlight.to(device),
          batch.skin.to(device)};
}

}  // namespace faceprobe::train
