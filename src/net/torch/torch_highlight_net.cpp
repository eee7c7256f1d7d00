#include "faceprobe/net/torch_highlight_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/safetensors.h"
#include "net/model_info.h"
#include "net/padded_picture.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/separator.h"
#include "net/torch/torch_device.h"

namespace faceprobe::net {

struct TorchHighlightNet::Impl {
  Device device;
  ModelInfo info;
  Separator separator;
};

std::string TorchHighlightNetOptions::validate() const {
  if (threads < 0) return "threads is " + std::to_string(threads) + "; it must be 0 (all processors) or more.";
  return {};
}

TorchHighlightNet::TorchHighlightNet(const std::filesystem::path& weights, const TorchHighlightNetOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  require_device(options.device);
  const io::TensorFile file = io::read_safetensors(weights);
  const ModelInfo info = model_info(file, weights.string());
  impl_ = std::make_unique<Impl>(Impl{options.device, info, make_separator(info, file, torch_device(options.device))});
  torch::set_num_threads(options.threads > 0 ? options.threads : default_thread_count());
}

TorchHighlightNet::TorchHighlightNet(TorchHighlightNet&&) noexcept = default;
TorchHighlightNet& TorchHighlightNet::operator=(TorchHighlightNet&&) noexcept = default;
TorchHighlightNet::~TorchHighlightNet() = default;

const ModelInfo& TorchHighlightNet::info() const { return impl_->info; }
const Device& TorchHighlightNet::device() const { return impl_->device; }

Image TorchHighlightNet::highlight(const Image& linear, const ByteImage& clip, const ByteImage& mask) const {
  check_sizes(linear, clip, mask);
  if (linear.empty()) return Image(linear.width(), linear.height(), 3);

  const c10::InferenceMode inference;
  PaddedPicture picture = pad_picture(linear, clip, mask, impl_->separator.multiple);
  const auto on_device = [&](Image& image) { return tensor_view(image).to(torch_device(impl_->device)); };
  const torch::Tensor result =
      impl_->separator.highlight(on_device(picture.linear), on_device(picture.clip), on_device(picture.mask));
  Image highlight = crop_to_picture(result, linear.width(), linear.height());
  keep_within(highlight, picture.linear, mask, is_grey(picture.linear));
  return highlight;
}

}  // namespace faceprobe::net
