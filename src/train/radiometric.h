#pragma once
// Finds the curve with which a camera departed from sRGB, from the skin of a face, in the spirit of Li et al. 2017,
// "Radiometric calibration from faces in images", which the paper's Section 5.1 uses: fine changes of skin's albedo
// come from two pigments, melanin and haemoglobin, so differences of log linear light lie in a plane through 0 of the
// three colour channels, whatever the light's colour. A wrong curve bends the plane. The curve is the one that leaves
// least of the third singular value.
//
//   const SkinTriples triples = skin_triples(encoded, skin_mask);
//   const ResponseFit fit = fit_response(triples);
//   if (!fit.kept_srgb) linear = linearise(encoded, fit.contrast);  // else sRGB, for fit.reason
//
// An approximation of that work: it fits the EMoR model of measured cameras, whose table is not at hand here; this fits
// one number. The family is a gamma on the odds of the code value around sRGB,
//
//   linear = srgb^-1(s),  s / (1 - s) = (code / (1 - code))^contrast,
//
// an S-curve like those that cameras lay over sRGB: contrast 1 is sRGB, below 1 undoes added contrast. A plain power of
// sRGB's inverse would be no use: it scales all log differences alike and leaves every plane a plane, so that no method
// of this kind can see it.
//
// Not for photos with an ICC profile or raw files, whose curve is known, and of no use on smooth, evenly lit or make-up
// covered skin: then, and whenever the evidence is weak, sRGB stays.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <string>

namespace faceprobe::train {

// The family above. `code`: clamped to [0, 1]. `contrast` > 0.
double linear_from_code(double code, double contrast);
// Linear light of code bytes; contrast 1 is decode_srgb(). Throws std::invalid_argument unless contrast is positive and
// finite.
Image linearise(const ByteImage& encoded, double contrast);

// Three places in a line on the skin: the change of albedo is that of the middle one against the mean of its
// neighbours, which shading, being smoother, does not enter to first order. Code values in (0, 1), #triples x 3
// channels.
struct SkinTriples {
  Eigen::MatrixX3d middle, before, after;
};

struct TripleOptions {
  int spacing_px = 3;  // between the places, each the mean of 3 x 3 pixels; 1 .. 100
  // Change of code that a triple must show in some channel: two codes, beyond what rounding to bytes makes.
  float min_change = 2.0F / 255;
  // And must not exceed in any: above are hairs, edges and shadows.
  float max_change = 0.12F;
  // Least part of the log change that is a change of colour: what changes all channels alike is relief, not pigment.
  float min_colour_share = 0.2F;

  std::string validate() const;  // empty when usable
};

// `encoded`: H x W x 3 code bytes as in the file. `skin`: H x W x 1, non-zero = skin without highlights, lips and hair.
// Pixels near the ends of the code range (below 8, above 247) take no part. May return no triples at all. Throws
// std::invalid_argument: options, sizes.
SkinTriples skin_triples(const ByteImage& encoded, const ByteImage& skin, const TripleOptions& options = {});

struct ResponseOptions {
  double max_contrast = 1.6;  // contrasts from 1 / max_contrast to max_contrast are tried; 1.05 .. 4
  int min_triples = 400;
  double min_gain = 0.25;         // least share of sRGB's residual that the curve must remove
  double max_residual = 0.03;     // of the curve; above it noise and relief decide, and noise looks like contrast > 1
  double max_disagreement = 0.1;  // between the curves of two halves of the skin, difference of log contrast

  std::string validate() const;  // empty when usable
};

struct ResponseFit {
  double contrast = 1;       // to use: the fitted one, or 1
  double fitted = 1;         // the best of the family, whatever the evidence
  double residual = 0;       // at `fitted`: third singular value over the sum of the three, 0 (a plane) .. 1/3
  double residual_srgb = 0;  // the same at contrast 1
  double disagreement = 0;   // as in the options
  Eigen::Index triples = 0;
  bool kept_srgb = true;
  std::string reason;  // why sRGB was kept: one sentence; empty when it was not
};

// Rows are weighted by the noise a code's rounding leaves in them, so that dark pixels do not decide. Never worse than
// sRGB in `residual`. Throws std::invalid_argument: options, shapes that differ, codes outside (0, 1).
ResponseFit fit_response(const SkinTriples& triples, const ResponseOptions& options = {});

}  // namespace faceprobe::train
