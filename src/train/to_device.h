#pragma once

#include "train/batch.h"

namespace faceprobe::train {

inline Batch to_device(const Batch& batch, const torch::Device& device) {
  if (device.is_cpu()) return batch;
  Batch out{batch.linear.to(device),    batch.clip.to(device), batch.mask.to(device),
            batch.highlight.to(device), batch.skin.to(device), {}};
  const SurfaceBatch& surface = batch.surface;
  if (surface.there()) {
    out.surface = {surface.mesh.to(device),   surface.normal.to(device), surface.depth_m.to(device),
                   surface.weight.to(device), surface.region.to(device), surface.shading.to(device),
                   surface.lit.to(device),    surface.open.to(device)};
  }
  return out;
}

}  // namespace faceprobe::train
