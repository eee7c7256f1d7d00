#pragma once
// Internal: one pixel of skin_subspace into highlight and skin, the light being known.

#include "faceprobe/highlight/skin_subspace.h"
#include "highlight/skin_pixel.h"

namespace faceprobe::highlight {

// Priors as covariances of log colour.
struct PixelPriors {
  // `level`: mean of the picture, against which noise counts.
  PixelPriors(const SkinSubspaceOptions& options, float level);

  Eigen::Matrix3f explained;  // what pigments and shading make
  float unexplained;          // variance in each channel beside that
  float noise;                // in linear light
  float log_ratio_precision;  // of the highlight against the expected one
};

// The most probable highlight and, given that, the most probable departure of the pixel's skin and shading. A pixel clipped in all
// channels keeps that of its surroundings and has no highlight.
void split_pixel(const PixelPriors& priors, const Eigen::Vector3f& log_skin, SkinPixel& pixel);

}  // namespace faceprobe::highlight
