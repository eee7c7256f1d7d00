#include "faceprobe/net/highlight_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/safetensors.h"
#include "net/model_info.h"
#include "net/picture_tensors.h"
#include "net/separator.h"
#include "net/torch_device.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::net {
namespace {

void check_sizes(const Image& linear, const ByteImage& clip, const ByteImage& mask) {
  if (!linear.empty() && linear.channels() != 3) {
    throw std::invalid_argument("HighlightNet: the picture must have 3 channels, not " +
                                std::to_string(linear.channels()));
  }
  for (const ByteImage* flags : {&clip, &mask}) {
    if (!flags->empty() && (!flags->same_size(linear) || flags->channels() != 1)) {
      throw std::invalid_argument("HighlightNet: clip and mask must have one channel and the size of the picture");
    }
  }
}

bool is_grey(const Image& picture) {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float* rgb = picture.pixel(x, y);
      if (rgb[0] != rgb[1] || rgb[1] != rgb[2]) return false;
    }
  }
  return true;
}

// The network's answer made to keep the promise of the header, whatever it was. `picture` is at least as large.
void finish(Image& highlight, const Image& picture, const ByteImage& mask, bool grey) {
  for (int y = 0; y < highlight.height(); ++y) {
    for (int x = 0; x < highlight.width(); ++x) {
      float* out = highlight.pixel(x, y);
      if (!mask.empty() && mask(x, y) == 0) {
        std::fill_n(out, 3, 0.0F);
        continue;
      }
      if (grey) std::fill_n(out, 3, out[0] / 3 + out[1] / 3 + out[2] / 3);
      for (int c = 0; c < 3; ++c) out[c] = std::isfinite(out[c]) ? std::clamp(out[c], 0.0F, picture(x, y, c)) : 0.0F;
    }
  }
}

}  // namespace

struct HighlightNet::Impl {
  Device device;
  ModelInfo info;
  Separator separator;
};

std::string HighlightNetOptions::validate() const {
  if (threads < 0) return "threads is " + std::to_string(threads) + "; it must be 0 (all processors) or more.";
  return {};
}

HighlightNet::HighlightNet(const std::filesystem::path& weights, const HighlightNetOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  require_device(options.device);
  const io::TensorFile file = io::read_safetensors(weights);
  const ModelInfo info = model_info(file, weights.string());
  impl_ = std::make_unique<Impl>(Impl{options.device, info, make_separator(info, file, torch_device(options.device))});
  torch::set_num_threads(options.threads > 0 ? options.threads : default_thread_count());
}

HighlightNet::HighlightNet(HighlightNet&&) noexcept = default;
HighlightNet& HighlightNet::operator=(HighlightNet&&) noexcept = default;
HighlightNet::~HighlightNet() = default;

const ModelInfo& HighlightNet::info() const { return impl_->info; }
const Device& HighlightNet::device() const { return impl_->device; }

Image HighlightNet::highlight(const Image& linear, const ByteImage& clip, const ByteImage& mask) const {
  check_sizes(linear, clip, mask);
  if (linear.empty()) return Image(linear.width(), linear.height(), 3);

  const c10::InferenceMode inference;
  PaddedPicture picture = pad_picture(linear, clip, mask, impl_->separator.multiple);
  const auto on_device = [&](Image& image) { return tensor_view(image).to(torch_device(impl_->device)); };
  const torch::Tensor result =
      impl_->separator.highlight(on_device(picture.linear), on_device(picture.clip), on_device(picture.mask));
  Image highlight = crop_to_picture(result, linear.width(), linear.height());
  finish(highlight, picture.linear, mask, is_grey(picture.linear));
  return highlight;
}

}  // namespace faceprobe::net
