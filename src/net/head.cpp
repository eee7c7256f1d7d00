#include "net/head.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::net {

float softplus(float x) { return std::max(x, 0.0F) + std::log1p(std::exp(-std::abs(x))); }

namespace {

// b I / (b^4 + I^4)^(1/4).
float smooth_min(float b, float light) {
  const float smaller = std::min(b, light);
  const float ratio = smaller / (std::max(b, light) + static_cast<float>(Head::kTiny));
  return smaller / std::sqrt(std::sqrt(1.0F + ratio * ratio * ratio * ratio));
}

}  // namespace

UNetOptions separator_options(const std::string& json, int inputs, int outputs) {
  UNetOptions options = unet_options_from_json(json);
  if (options.in_channels != inputs || options.out_channels != outputs) {
    throw Error(ExitCode::kModel, "The weights are of a network with " + std::to_string(options.in_channels) +
                                      " channels in and " + std::to_string(options.out_channels) +
                                      " out; its kind has " + std::to_string(inputs) + " and " +
                                      std::to_string(outputs) + ". Use weights made for it.");
  }
  return options;
}

Image network_input(const PaddedPicture& picture) {
  Image input(picture.linear.width(), picture.linear.height(), kInputChannels);
  for (int y = 0; y < input.height(); ++y) {
    for (int x = 0; x < input.width(); ++x) {
      float* out = input.pixel(x, y);
      for (int c = 0; c < 3; ++c) {
        const float light = std::clamp(picture.linear(x, y, c), static_cast<float>(Head::kDarkest),
                                       static_cast<float>(Head::kBrightest));
        out[c] = std::pow(light, static_cast<float>(1 / Head::kGamma)) - 0.5F;
        out[3 + c] = picture.clip(x, y, c) - 0.5F;
      }
      out[6] = picture.mask(x, y) - 0.5F;
    }
  }
  return input;
}

Image highlight_of_raw(const Image& raw, const Image& linear) {
  Image highlight(linear.width(), linear.height(), 3);
  const auto largest = static_cast<float>(Head::kLargestRaw);
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      const float* light = linear.pixel(x, y);
      const float* from = raw.pixel(x, y);
      const auto limited = [from, largest](int c) { return std::clamp(from[c], -largest, largest); };
      const float amount = luminance(light) * softplus(limited(0) + static_cast<float>(Head::kAmountOffset));
      float colour[3];
      float sum = 0;
      for (int c = 0; c < 3; ++c) {
        colour[c] = softplus(limited(1 + c)) + static_cast<float>(Head::kColourFloor);
        sum += colour[c];
      }
      for (int c = 0; c < 3; ++c) highlight(x, y, c) = smooth_min(amount * colour[c] / (sum / 3.0F), light[c]);
    }
  }
  return highlight;
}

}  // namespace faceprobe::net
