#pragma once
// The mean of the highlight layers that a network finds in a picture and in its mirror image: a mirrored photo then has the mirrored
// layer exactly, and the error is a little smaller (faceprobe eval highlight). Takes twice the time.
//
//   const net::HighlightNet network("models/highlight.safetensors");
//   const Image highlight = net::highlight_both_ways(network, crop, clip, mask);

#include "faceprobe/core/mirror.h"

namespace faceprobe::net {

// Net: HighlightNet or TorchHighlightNet; arguments and result as its highlight(). The bounds of that hold for the mean too.
template <class Net>
Image highlight_both_ways(const Net& network, const Image& linear, const ByteImage& clip, const ByteImage& mask) {
  Image highlight = network.highlight(linear, clip, mask);
  const Image other = mirrored(network.highlight(mirrored(linear), mirrored(clip), mirrored(mask)));
  for (std::size_t i = 0; i < highlight.values().size(); ++i)
    highlight.data()[i] = 0.5F * (highlight.data()[i] + other.data()[i]);
  return highlight;
}

}  // namespace faceprobe::net
