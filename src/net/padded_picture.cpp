#include "net/padded_picture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace faceprobe::net {
namespace {

int round_up(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

float usable(float light) { return std::isfinite(light) && light > 0 ? light : 0.0F; }

}  // namespace

PaddedPicture pad_picture(const Image& linear, const ByteImage& clip, const ByteImage& mask, int multiple) {
  const int width = round_up(linear.width(), multiple), height = round_up(linear.height(), multiple);
  PaddedPicture result{Image(width, height, 3), Image(width, height, 3), Image(width, height, 1)};
  for (int y = 0; y < height; ++y) {
    const int from_y = std::min(y, linear.height() - 1);
    for (int x = 0; x < width; ++x) {
      const int from_x = std::min(x, linear.width() - 1);
      const unsigned flags = clip.empty() ? 0U : clip(from_x, from_y);
      for (int c = 0; c < 3; ++c) {
        result.linear(x, y, c) = usable(linear(from_x, from_y, c));
        result.clip(x, y, c) = static_cast<float>((flags >> c) & 1U);
      }
      result.mask(x, y) = mask.empty() || mask(from_x, from_y) != 0 ? 1.0F : 0.0F;
    }
  }
  return result;
}

Image top_left(const Image& image, int width, int height) {
  Image out(width, height, image.channels());
  for (int y = 0; y < height; ++y) {
    const auto from = image.row(y).first(out.row(y).size());
    std::copy(from.begin(), from.end(), out.row(y).begin());
  }
  return out;
}

void keep_within(Image& highlight, const Image& linear, const ByteImage& mask, bool grey) {
  for (int y = 0; y < highlight.height(); ++y) {
    for (int x = 0; x < highlight.width(); ++x) {
      float* out = highlight.pixel(x, y);
      if (!mask.empty() && mask(x, y) == 0) {
        std::fill_n(out, 3, 0.0F);
        continue;
      }
      if (grey) std::fill_n(out, 3, out[0] / 3 + out[1] / 3 + out[2] / 3);
      for (int c = 0; c < 3; ++c) out[c] = std::isfinite(out[c]) ? std::clamp(out[c], 0.0F, linear(x, y, c)) : 0.0F;
    }
  }
}

bool is_grey(const Image& linear) {
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      const float* rgb = linear.pixel(x, y);
      if (rgb[0] != rgb[1] || rgb[1] != rgb[2]) return false;
    }
  }
  return true;
}

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

}  // namespace faceprobe::net
