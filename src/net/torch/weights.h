#pragma once
// A network's parameters and buffers to a .safetensors file and back, each under its name in the module
// ("encoder.0.units.0.conv.weight"). All or nothing: a file that lacks a tensor, or holds one the network does not have,
// belongs to another network.
//
//   save_weights(*unet, path, {{kArchitectureKey, kUNetArchitecture}, {kOptionsKey, options_json(unet->options())}}, true);
//   load_weights(*unet, path);

#include "faceprobe/io/safetensors.h"

#include <torch/torch.h>
#include <filesystem>
#include <map>
#include <string>

namespace faceprobe::net {

// As F16 when `half`, else F32. Throws Error(kOutput): a tensor holds NaN or infinity (nothing is written then), or the file
// cannot be written.
void save_weights(const torch::nn::Module& module, const std::filesystem::path& path,
                  const std::map<std::string, std::string>& metadata, bool half);

// Throws Error(kModel) that names the tensor and the shapes; the module is unchanged then. It stays on its device.
void load_weights(torch::nn::Module& module, const std::filesystem::path& path);
void load_weights(torch::nn::Module& module, const io::TensorFile& file);
// The same for a network that is no longer trained: on the device, without dropout and with the means that it has seen.
void load_for_use(torch::nn::Module& module, const io::TensorFile& file, const torch::Device& device);

}  // namespace faceprobe::net
