#pragma once
// Carries a highlight layer that was estimated on a small copy of a picture over to the full picture: the highlight follows
// the picture's own detail, down to pores, instead of being blown up. Around every pixel of the small copy the highlight is
// fitted as an affine function of the colour; the full picture's colours are put into these functions (fast guided filter:
// He & Sun 2015, "Fast guided filter", arXiv:1505.00996; He, Sun & Tang 2013, PAMI 35, for the colour guide).
//
// Not for layers that the colours do not tell apart: in a grey picture, where highlight and texture look alike, it hands
// part of the texture to the highlight. Not for making a layer smaller.
//
//   const Image small = shrink(crop, 512);                              // any way of shrinking that averages
//   const Image highlight = upsample_highlight(separate(small, {}, {}).highlight, small, crop, mask);
//
// Time grows with the pixels of the full picture, and with those of the small one times the radius.

#include "faceprobe/core/image.h"

#include <string>

namespace faceprobe::highlight {

struct UpsampleOptions {
  // Windows are squares of 2 radius + 1 pixels of the small picture. Smaller follows faster changes of colour, larger is
  // steadier.
  int radius_px = 4;
  // Variance of the colour, in squares of linear light, under which it tells nothing and the highlight is taken as
  // constant.
  float epsilon = 1e-5F;
  int threads = 0;

  std::string validate() const;
};

// `small_highlight` and `small_picture`: h x w x 3, linear. `picture`: H x W x 3, linear, the same frame with more pixels:
// the corners of both coincide, and W / w may differ from H / h. `mask`: H x W x 1, non-zero where a highlight is wanted;
// empty = everywhere. Small pixels whose centre is outside it are not learnt from, nor are those that are not finite.
//
// Gives H x W x 3, linear: 0 <= highlight <= max(picture, 0) in each channel; 0 outside the mask, where no small pixel in
// reach could be learnt from, and where the picture is not finite. Any number of threads gives the same result.
// Throws std::invalid_argument when the sizes do not fit or the small picture is empty and the full one is not, Error(kUsage)
// for options that are not valid.
Image upsample_highlight(const Image& small_highlight, const Image& small_picture, const Image& picture,
                         const ByteImage& mask = {}, const UpsampleOptions& options = {});

}  // namespace faceprobe::highlight
