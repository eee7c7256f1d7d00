#include "faceprobe/net/torch_shading_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/mirror.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/model_info.h"
#include "net/padded_picture.h"
#include "net/torch/albedo_shading.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/shi.h"
#include "net/torch/torch_device.h"
#include "net/torch/weights.h"

#include <functional>

namespace faceprobe::net {
namespace {

// A picture as a tensor to both of its layers, N x 3 x H x W each.
struct Splitter {
  int multiple = 1;
  bool takes_diffuse = false;
  std::function<LogLayers(const torch::Tensor&)> see;  // as the network says them, which is what is averaged
  std::function<torch::Tensor(const torch::Tensor&)> light_of;
};

Splitter make_splitter(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device) {
  if (info.architecture == kAlbedoShadingArchitecture) {
    const AlbedoShadingOptions options = albedo_shading_options_from_json(info.options_json);
    AlbedoShading net(options);
    load_for_use(*net, file, device);
    // Logarithms are averaged, in which two levels make a third.
    return {kMscrMultiple, true,
            [net, options](const torch::Tensor& x) mutable { return net(albedo_shading_input(x, options)); },
            [options](const torch::Tensor& log) { return light_of_log(log, options); }};
  }
  if (info.architecture == kShiArchitecture) {
    Shi net(shi_options_from_json(info.options_json));
    load_for_use(*net, file, device);
    return {net->multiple(), false,
            [net](const torch::Tensor& x) mutable {
              const ShiLayers layers = net(shi_input(x));
              return LogLayers{layers.albedo, layers.shading};
            },
            [](const torch::Tensor& light) { return light.clamp_min(0); }};
  }
  throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                    "; shading is split here by albedo_shading and shi. Use weights made for it.");
}

}  // namespace

struct TorchShadingNet::Impl {
  Device device;
  ModelInfo info;
  Splitter splitter;
};

std::string TorchShadingNetOptions::validate() const {
  if (threads < 0) return "threads is " + std::to_string(threads) + "; it must be 0 (all processors) or more.";
  return {};
}

TorchShadingNet::TorchShadingNet(const std::filesystem::path& weights, const TorchShadingNetOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  require_device(options.device);
  const io::TensorFile file = io::read_safetensors(weights);
  const ModelInfo info = model_info(file, weights.string());
  impl_ = std::make_unique<Impl>(Impl{options.device, info, make_splitter(info, file, torch_device(options.device))});
  torch::set_num_threads(options.threads > 0 ? options.threads : default_thread_count());
}

TorchShadingNet::TorchShadingNet(TorchShadingNet&&) noexcept = default;
TorchShadingNet& TorchShadingNet::operator=(TorchShadingNet&&) noexcept = default;
TorchShadingNet::~TorchShadingNet() = default;

bool TorchShadingNet::takes_diffuse() const { return impl_->splitter.takes_diffuse; }

const ModelInfo& TorchShadingNet::info() const { return impl_->info; }

ShadingLayers TorchShadingNet::layers(const Image& picture) const {
  check_sizes(picture, {}, {});
  if (picture.empty())
    return {Image(picture.width(), picture.height(), 3), Image(picture.width(), picture.height(), 3)};
  const c10::InferenceMode inference;
  const Splitter& splitter = impl_->splitter;
  PaddedPicture padded = pad_picture(picture, {}, {}, splitter.multiple);
  // Mirrored before it is padded, as by both_ways.h.
  PaddedPicture turned = pad_picture(mirrored(picture), {}, {}, splitter.multiple);
  const auto see = [&](Image& image) { return splitter.see(tensor_view(image).to(torch_device(impl_->device))); };
  const LogLayers straight = see(padded.linear);
  const LogLayers back = see(turned.linear);
  const auto both = [&](const torch::Tensor& a, const torch::Tensor& b) {
    const torch::Tensor seen = a.narrow(3, 0, picture.width()) + b.narrow(3, 0, picture.width()).flip(3);
    const torch::Tensor light = splitter.light_of(0.5 * seen);
    return crop_to_picture(torch::where(torch::isfinite(light), light, torch::zeros_like(light)), picture.width(),
                           picture.height());
  };
  return {both(straight.albedo, back.albedo), both(straight.shading, back.shading)};
}

}  // namespace faceprobe::net
