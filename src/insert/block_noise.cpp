#include "insert/block_noise.h"

#include "faceprobe/core/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace faceprobe::insert {
namespace {

constexpr double kMostBlocks = 2500;  // encoding them is what takes the time
constexpr float kBlackCode = 2.0F / 255, kWhiteCode = 253.0F / 255;

bool block_is_whole(const Image& linear, int left, int top) {
  static const float black = linear_from_srgb(kBlackCode);
  static const float white = linear_from_srgb(kWhiteCode);
  const auto within = [](float value) { return value >= black && value <= white; };  // NaN is not
  for (int y = top; y < top + kBlockSide; ++y) {
    const float* first = linear.pixel(left, y);
    if (!std::all_of(first, first + kBlockSide * linear.channels(), within)) return false;
  }
  return true;
}

Block encoded_channel(const Image& linear, int left, int top, int channel) {
  Block block;
  for (int y = 0; y < kBlockSide; ++y) {
    for (int x = 0; x < kBlockSide; ++x) {
      block(y, x) = static_cast<double>(srgb_from_linear(linear(left + x, top + y, channel)));
    }
  }
  return block;
}

BlockNoise measure(const Image& linear, int left, int top, const BlockFit& fit) {
  const int channels = linear.channels();
  std::array<Block, 3> encoded;
  Block mean = Block::Zero();
  for (int c = 0; c < channels; ++c) {
    Block& block = encoded.at(static_cast<std::size_t>(c));
    block = encoded_channel(linear, left, top, c);
    mean += block / channels;
  }
  BlockNoise noise;
  for (int c = 0; c < channels; ++c) {
    Block difference = encoded.at(static_cast<std::size_t>(c)) - mean;
    fit.remove(difference);
    const Moments moments = moments_of(difference);
    noise.colour.variance += moments.variance / channels;
    noise.colour.covariance += moments.covariance / channels;
  }
  noise.brightness = mean.mean();
  fit.remove(mean);
  noise.shared = moments_of(mean);
  return noise;
}

}  // namespace

std::vector<BlockNoise> measure_blocks(const Image& linear, const BlockFit& fit) {
  const double whole_blocks =
      static_cast<double>(linear.width() / kBlockSide) * static_cast<double>(linear.height() / kBlockSide);
  // Whole multiples of the side, so that blocks lie on JPEG's own.
  const int step = kBlockSide * std::max(1, static_cast<int>(std::ceil(std::sqrt(whole_blocks / kMostBlocks))));
  std::vector<BlockNoise> blocks;
  for (int top = 0; top + kBlockSide <= linear.height(); top += step) {
    for (int left = 0; left + kBlockSide <= linear.width(); left += step) {
      if (block_is_whole(linear, left, top)) blocks.push_back(measure(linear, left, top, fit));
    }
  }
  return blocks;
}

}  // namespace faceprobe::insert
