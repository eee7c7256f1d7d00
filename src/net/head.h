#pragma once
// What goes into the small network and what its raw output means, for one picture on a processor. torch/highlight_head.h is the same for
// training, and says why it is so.
//
//   const Image raw = unet(network_input(padded));
//   const Image highlight = highlight_of_raw(raw, padded.linear);

#include "faceprobe/core/image.h"
#include "net/padded_picture.h"
#include "net/unet_options.h"

#include <string>

namespace faceprobe::net {

constexpr int kInputChannels = 7;  // encoded red, green, blue; clipped red, green, blue; face
constexpr int kRawChannels = 4;    // amount; colour of the light red, green, blue

struct Head {
  static constexpr double kGamma = 2.2;
  static constexpr double kDarkest = 1e-6;  // keeps the slope of the encoding finite at black
  static constexpr double kBrightest = 64;
  static constexpr double kAmountOffset = -2;   // softplus(-2) = 0.127
  static constexpr double kColourFloor = 1e-3;  // a colour stays defined where all three outputs are far below zero
  static constexpr double kLargestRaw = 100;    // far beyond use; products of larger ones would overflow
  static constexpr double kTiny = 1e-30;        // 0 / 0 becomes 0
};

// Options of a network with so many inputs and outputs. Throws Error(kModel).
UNetOptions separator_options(const std::string& json, int inputs = kInputChannels, int outputs = kRawChannels);

float softplus(float x);

// H x W x 7.
Image network_input(const PaddedPicture& picture);

// `raw`: H x W x 4 or more, any numbers; `linear`: H x W x 3, finite, >= 0. Result: H x W x 3 with 0 <= highlight <= linear.
Image highlight_of_raw(const Image& raw, const Image& linear);

}  // namespace faceprobe::net
