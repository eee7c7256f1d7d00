#pragma once
// Our device as libtorch's.

#include "faceprobe/net/device.h"

#include <torch/torch.h>

namespace faceprobe::net {

inline torch::Device torch_device(const Device& device) {
  return device.cuda ? torch::Device(torch::kCUDA, static_cast<c10::DeviceIndex>(device.index))
                     : torch::Device(torch::kCPU);
}

}  // namespace faceprobe::net
