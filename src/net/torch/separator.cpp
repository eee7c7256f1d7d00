#include "net/torch/separator.h"

#include "faceprobe/core/error.h"
#include "io/safetensors_header.h"
#include "net/torch/highlight_head.h"
#include "net/torch/mscr.h"
#include "net/torch/shi.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"

namespace faceprobe::net {
namespace {

Separator unet_separator(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device) {
  UNet net(separator_options(info.options_json));
  load_for_use(*net, file, device);
  return {net->multiple(), [net](const auto& linear, const auto& clip, const auto& mask) mutable {
            return highlight_from_raw(net(prepare_input(linear, clip, mask)), linear);
          }};
}

Separator mscr_separator(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device) {
  Mscr net(mscr_options_from_json(info.options_json));
  load_for_use(*net, file, device);
  return {kMscrMultiple, [net](const auto& linear, const auto&, const auto&) mutable {
            return torch::minimum(net(mscr_input(linear, net->options())).clamp_min(0), linear);
          }};
}

Separator shi_separator(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device) {
  Shi net(shi_options_from_json(info.options_json));
  load_for_use(*net, file, device);
  return {net->multiple(), [net](const auto& linear, const auto&, const auto&) mutable {
            return torch::minimum(net(shi_input(linear)).highlight.clamp_min(0), linear);
          }};
}

}  // namespace

Separator make_separator(const ModelInfo& info, const io::TensorFile& file, const torch::Device& device) {
  if (info.architecture == kUNetArchitecture) return unet_separator(info, file, device);
  if (info.architecture == kMscrArchitecture) return mscr_separator(info, file, device);
  if (info.architecture == kShiArchitecture) return shi_separator(info, file, device);
  throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                    "; this version runs unet, mscr and shi. Use weights made for it.");
}

}  // namespace faceprobe::net
