#pragma once
// The U-Net of the highlight separation, trained, on a processor: the same numbers as torch/unet.h, without libtorch, whose start alone
// takes half a second.
//
//   WeightList weights(file);
//   const UNetRunner net(options, weights);
//   const Image raw = net(input);   // H x W x in -> H x W x out; H, W multiples of options.multiple()

#include "net/convolution.h"
#include "net/group_norm.h"
#include "net/unet_options.h"

#include <vector>

namespace faceprobe::net {

class UNetRunner {
 public:
  // Throws Error(kModel): weights that do not fit the options.
  UNetRunner(const UNetOptions& options, WeightList& weights);

  // May be called from several threads. Throws std::invalid_argument for another number of channels or a size that is no multiple.
  Image operator()(const Image& input) const;

  const UNetOptions& options() const { return options_; }

 private:
  struct Unit {
    Convolution convolution;
    GroupNormSilu norm;
    Image operator()(const Image& features) const;
  };
  using Level = std::vector<Unit>;
  Level make_level(WeightList& weights, const std::string& name, int in, int out, int stride) const;
  static Image run(const Level& level, const Image& features);

  UNetOptions options_;
  std::vector<Level> encoder_, decoder_;             // by level, finest first
  std::vector<Convolution> from_skip_, from_below_;  // 1x1, by level of the decoder
  std::vector<Convolution> head_;                    // one
};

}  // namespace faceprobe::net
