#include "pipeline/highlight_layers.h"

#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/upsample.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/net/both_ways.h"
#include "faceprobe/net/highlight_net.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {

bool shows_enough(const face::Crop& crop, int photo_width, int photo_height) {
  // The network learnt from whole heads; of the middle of a face alone, as in pictures that are cropped inside the hairline, it makes
  // shading a highlight.
  constexpr double kLeastShown = 2.0 / 3.0;
  const double width = crop.width / crop.scale;
  const double height = crop.height / crop.scale;
  const double shown_width = std::min(crop.x_px + width, static_cast<double>(photo_width)) - std::max(crop.x_px, 0.0);
  const double shown_height = std::min(crop.y_px + height, static_cast<double>(photo_height)) - std::max(crop.y_px, 0.0);
  return std::max(0.0, shown_width) * std::max(0.0, shown_height) >= kLeastShown * width * height;
}

namespace {

// A clipped channel keeps what is diffuse, as the network has learnt, so that the highlight lacks that colour: cyan where red is clipped.
// The light had no such hole; it is taken to have been as bright there as in the channels that were not clipped.
void fill_clipped(const ByteImage& flags, const Image& picture, Image& highlight) {
  for (int y = 0; y < highlight.height(); ++y) {
    for (int x = 0; x < highlight.width(); ++x) {
      const unsigned clipped = flags(x, y) & 7U;
      if (clipped == 0 || clipped == 7U) continue;
      float* out = highlight.pixel(x, y);
      float sum = 0;
      int count = 0;
      for (unsigned c = 0; c < 3; ++c) {
        if ((clipped >> c & 1U) != 0) continue;
        sum += out[c];
        ++count;
      }
      const float others = sum / static_cast<float>(count);
      for (unsigned c = 0; c < 3; ++c) {
        if ((clipped >> c & 1U) != 0) out[c] = std::max(out[c], std::min(others, picture(x, y, static_cast<int>(c))));
      }
    }
  }
}

}  // namespace

struct HighlightSeparator::Network {
  net::HighlightNet net;
  int threads;
  // Long side of the copy. Synthetic faces of 128 px fill their pictures about as a crop does.
  static constexpr int kLongSidePx = 128;

  highlight::Layers separate(const Image& picture, const ByteImage& flags, const ByteImage& skin) const {
    const int long_side = std::max(picture.width(), picture.height());
    const double scale = std::min(1.0, static_cast<double>(kLongSidePx) / long_side);
    const auto shrunk = [scale](int px) { return std::max(1, static_cast<int>(std::lround(scale * px))); };
    const face::Crop copy{
        .x_px = 0, .y_px = 0, .scale = scale, .width = shrunk(picture.width()), .height = shrunk(picture.height())};
    const Image small = face::crop_picture(picture, copy);
    ByteImage where(skin.width(), skin.height(), 1);
    std::transform(skin.values().begin(), skin.values().end(), where.values().begin(),
                   [](std::uint8_t value) { return value != 0 ? std::uint8_t{1} : std::uint8_t{0}; });
    const ByteImage small_flags = face::crop_flags(flags, copy);
    Image found = net::highlight_both_ways(net, small, small_flags, face::crop_flags(where, copy));
    fill_clipped(small_flags, small, found);  // here, where no pixel stands apart from its neighbours
    highlight::Layers layers;
    layers.highlight = highlight::upsample_highlight(found, small, picture, where, {.threads = threads});
    layers.diffuse = picture;
    for (std::size_t i = 0; i < picture.values().size(); ++i) layers.diffuse.data()[i] -= layers.highlight.data()[i];
    return layers;
  }
};

HighlightSeparator::HighlightSeparator(const EstimateOptions& options)
    : classical_{.separator = options.classical.value_or(highlight::Separator::kYang), .threads = options.threads} {
  if (options.classical) return;
  const std::filesystem::path weights =
      options.highlight_weights.empty() ? io::data_file("highlight.safetensors") : options.highlight_weights;
  const net::HighlightNetOptions net_options{.threads = options.threads};
  network_ = std::make_unique<Network>(Network{net::HighlightNet(weights, net_options), options.threads});
}

HighlightSeparator::~HighlightSeparator() = default;

highlight::Layers HighlightSeparator::separate(const Image& picture, const ByteImage& flags, const ByteImage& skin,
                                               bool enough) const {
  if (network_ && enough) return network_->separate(picture, flags, skin);
  return highlight::separate(picture, skin, classical_);
}

}  // namespace faceprobe::pipeline
