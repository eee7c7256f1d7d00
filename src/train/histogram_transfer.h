#pragma once
// Makes the colours of one photo of a person like those of another, so that lights of different colours do not add a
// rank to the low-rank loss (the paper's Section 5.1, "histogram transfer"): in each channel by itself, the monotone
// curve that gives the pixels inside the mask the distribution of the reference's.
//
//   const Image matched = transfer_histogram(frontal[k], mask[k], frontal[0], mask[0]);
//
// Not for photos lit by lights of several colours, and not for pictures whose light is estimated afterwards: the curves
// are not those of a change of light, they also take over the reference's contrast. Highlights pass through the curves
// too, as they do in the paper.

#include "faceprobe/core/image.h"

#include <string>
#include <vector>

namespace faceprobe::train {

struct HistogramTransferOptions {
  // Over the values of both pictures, of equal width in their square root: about as fine as code values everywhere.
  int bins = 1024;

  std::string validate() const;  // empty when usable
};

// The curve of one channel, in linear light: strictly increasing, continuous and finite everywhere; beyond the values
// of both sets it changes nothing. Both distributions are linear within bins, with a small uniform part that keeps
// them, and so the curve, from being flat.
class HistogramCurve {
 public:
  // The values inside the masks, in any order. Throws std::invalid_argument: no values, or values that are not finite.
  HistogramCurve(const std::vector<float>& values, const std::vector<float>& reference, int bins);

  double operator()(double linear) const;

 private:
  double low_, bin_width_;         // on the axis of square roots
  std::vector<double> from_, to_;  // shares below each of the bins + 1 edges
};

// `picture`, `reference`: any sizes, the same number of channels, linear. Masks: the size of their picture, one
// channel, non-zero = inside; empty = everywhere. Pixels outside the mask keep their values. Equal histograms give the
// picture back (to float's rounding). Throws std::invalid_argument: options, sizes, no pixel inside a mask, values
// inside it that are not finite.
Image transfer_histogram(const Image& picture, const ByteImage& mask, const Image& reference,
                         const ByteImage& reference_mask, const HistogramTransferOptions& options = {});

}  // namespace faceprobe::train
