#include "net/torch/weights.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/tensor_file.h"
#include "io/safetensors_header.h"
#include "net/weight_list.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::net {
namespace {

// The tensors share their storage with the module.
std::vector<std::pair<std::string, torch::Tensor>> state_of(const torch::nn::Module& module) {
  std::vector<std::pair<std::string, torch::Tensor>> state;
  for (const auto& item : module.named_parameters()) state.emplace_back(item.key(), item.value());
  for (const auto& item : module.named_buffers()) state.emplace_back(item.key(), item.value());
  for (const auto& [name, tensor] : state) {
    if (!tensor.is_floating_point())
      throw std::invalid_argument("weights: " + name + " holds no floating-point numbers");
  }
  return state;
}

std::span<const float> values_of(const torch::Tensor& contiguous) {
  return {contiguous.data_ptr<float>(), static_cast<std::size_t>(contiguous.numel())};
}

}  // namespace

void save_weights(const torch::nn::Module& module, const std::filesystem::path& path,
                  const std::map<std::string, std::string>& metadata, bool half) {
  const torch::NoGradGuard no_grad;
  io::TensorFileBuilder builder;
  for (const auto& [key, value] : metadata) builder.set_metadata(key, value);
  for (const auto& [name, tensor] : state_of(module)) {
    const torch::Tensor plain = tensor.to(torch::kCPU, torch::kFloat32).contiguous();
    if (!torch::isfinite(plain).all().item<bool>()) {
      throw Error(ExitCode::kOutput, "The weights were not written to " + path.string() + ": tensor " + io::quoted(name) +
                                         " holds NaN or infinity. The training has diverged; lower its learning rate.");
    }
    if (half) {
      io::to_half(values_of(plain), builder.add<io::Half>(name, tensor.sizes().vec()));
    } else {
      std::ranges::copy(values_of(plain), builder.add<float>(name, tensor.sizes().vec()).begin());
    }
  }
  builder.write(path);
}

void load_weights(torch::nn::Module& module, const io::TensorFile& file) {
  const auto state = state_of(module);
  // All is checked before anything is changed.
  WeightList weights(file);
  std::vector<std::vector<float>> values;
  for (const auto& [name, tensor] : state) values.push_back(weights.take(name, tensor.sizes().vec()));
  weights.finish();
  const torch::NoGradGuard no_grad;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const torch::Tensor& to = state[i].second;
    torch::Tensor(to).copy_(torch::from_blob(values[i].data(), to.sizes(), torch::kFloat32));
  }
}

void load_for_use(torch::nn::Module& module, const io::TensorFile& file, const torch::Device& device) {
  load_weights(module, file);
  module.to(device);
  module.eval();
}

void load_weights(torch::nn::Module& module, const std::filesystem::path& path) {
  load_weights(module, io::read_safetensors(path));
}

}  // namespace faceprobe::net
