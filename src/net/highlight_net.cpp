#include "faceprobe/net/highlight_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/head.h"
#include "net/model_info.h"
#include "net/padded_picture.h"
#include "net/thread_count.h"
#include "net/unet_runner.h"

#include <algorithm>

namespace faceprobe::net {
namespace {

UNetRunner make_runner(const ModelInfo& info, const io::TensorFile& file) {
  if (info.architecture != kUNetArchitecture) {
    throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                      "; highlights alone are taken off by unet. Use weights made for it.");
  }
  WeightList weights(file);
  UNetRunner runner(separator_options(info.options_json), weights);
  weights.finish();
  return runner;
}

}  // namespace

struct HighlightNet::Impl {
  int threads;
  ModelInfo info;
  UNetRunner net;
};

std::string HighlightNetOptions::validate() const {
  if (threads < 0) return "threads is " + std::to_string(threads) + "; it must be 0 (all processors) or more.";
  return {};
}

HighlightNet::HighlightNet(const std::filesystem::path& weights, const HighlightNetOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const io::TensorFile file = io::read_safetensors(weights);
  ModelInfo info = model_info(file, weights.string());
  UNetRunner runner = make_runner(info, file);
  impl_ = std::make_unique<Impl>(Impl{options.threads, std::move(info), std::move(runner)});
}

HighlightNet::HighlightNet(HighlightNet&&) noexcept = default;
HighlightNet& HighlightNet::operator=(HighlightNet&&) noexcept = default;
HighlightNet::~HighlightNet() = default;

const ModelInfo& HighlightNet::info() const { return impl_->info; }

Image HighlightNet::highlight(const Image& linear, const ByteImage& clip, const ByteImage& mask) const {
  check_sizes(linear, clip, mask);
  if (linear.empty()) return Image(linear.width(), linear.height(), 3);
  const ThreadCount threads(impl_->threads);
  const PaddedPicture picture = pad_picture(linear, clip, mask, impl_->net.options().multiple());
  Image highlight =
      top_left(highlight_of_raw(impl_->net(network_input(picture)), picture.linear), linear.width(), linear.height());
  keep_within(highlight, picture.linear, mask, is_grey(picture.linear));
  return highlight;
}

}  // namespace faceprobe::net
