#pragma once
// What keeps unsupervised finetuning honest. Two things: which photos to leave out (the paper's Section 5.1 removed by
// hand those with a strong expression or several light colours), and penalties for the three separations that make the
// low-rank loss small for the wrong reason: the diffuse layer is black, or all of one colour, or the colours of the
// skin have gone into the highlight.
//
//   PhotoMeasures measures = measure_photo(frontal, masks);
//   measures.reprojection_share = face.reprojection_rms_px / face.box.width;
//   measures.light_colour_spread = chroma_spread(shading, masks.seen);
//   if (const std::string why = why_unsuitable(measures); !why.empty()) leave_out(photo, why);
//
//   const Penalty black = black_diffuse(picture, highlight, weight);
//   gradient += 0.1 * black.gradient;  // each penalty is 0 for a sane separation and near 1 at its trivial minimum
//
// Penalties do not replace the supervised term on synthetic faces in each batch, nor a small learning rate: they catch
// the ends of the road. Matrices are as in train/chromaticity.h: one row per pixel, one column per channel, linear
// light, picture = highlight + diffuse.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <string>

namespace faceprobe::train {

// Of a photo in the template's square (train/frontalise.h), S x S x 1, non-zero = yes.
struct PhotoMasks {
  ByteImage skin;     // where the template has skin
  ByteImage seen;     // where the photo shows the face
  ByteImage clipped;  // where the photo was clipped; empty = nowhere
};

struct PhotoMeasures {
  // Root mean square difference of luminance between neighbours, over that at four pixels: 1/4 where nothing is finer
  // than four pixels (out of focus, or enlarged from a small face), about 1/2 for natural pictures, 1 for noise.
  // Exposure and contrast do not enter.
  double sharpness = 0;
  double occluded_share = 0;       // of the skin that the photo does not show, 0 .. 1
  double clipped_share = 0;        // of the skin that it shows, 0 .. 1
  double reprojection_share = 0;   // Face::reprojection_rms_px, of the rigid mean face, per width of the face
  double light_colour_spread = 0;  // chroma_spread() of the diffuse shading: several light colours
};

// Defaults are own choices, not the paper's, which names none.
struct PhotoLimits {
  double min_sharpness = 0.3;
  double max_occluded_share = 0.35;
  double max_clipped_share = 0.05;
  double max_reprojection_share = 0.04;  // an open mouth or a wide smile
  double max_light_colour_spread = 0.03;
};

// The first three measures; the caller fills in the other two. `frontal`: S x S x 3, linear. Throws
// std::invalid_argument: sizes, no skin.
PhotoMeasures measure_photo(const Image& frontal, const PhotoMasks& masks);
// Root mean square distance of the chromaticities (r, g) / (r + g + b) from their mean, weighted by r + g + b; 0 where
// nothing is lit. `shading`: H x W x 3, >= 0: diffuse shading (picture over albedo), or one photo over the mean of the
// person's. `mask` as above.
double chroma_spread(const Image& shading, const ByteImage& mask);
// Empty when the photo can be used; else one sentence with the number and the limit.
std::string why_unsuitable(const PhotoMeasures& measures, const PhotoLimits& limits = {});

struct Penalty {
  double value = 0;
  Eigen::MatrixX3d gradient;  // of `value` by the highlight; the size of it
};

// All three: `picture`, `highlight`: #pixels x 3; `weight`: #pixels, >= 0, 0 = not in the mask. Values are weighted
// means over the mask and do not depend on resolution or exposure; gradients are continuous. value > 0 says that the
// separation is on the way to that minimum. Throw std::invalid_argument: sizes, no weight, options out of range.

// (a) The diffuse layer goes to 0, or below, where chromaticity is constant or meaningless: mean over pixels and
// channels of max(0, 1 - (I - H) / (least I))^2. Silent while every channel keeps the share `least` of the picture's
// light, 0 < least < 1: under a highlight twice as bright as skin, its blue still has a tenth.
Penalty black_diffuse(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight, const Eigen::VectorXd& weight,
                      double least = 0.1);

// (b) The diffuse layer takes one colour everywhere: max(0, 1 - v / (least v_ref))^2, v the variance of its
// chromaticity (r, g) / (r + g + b). `reference_variance`, > 0: chroma_variance() of a diffuse layer to be trusted,
// such as that of the network before finetuning. Real finetuning takes out the white of highlights it missed, so that
// less than all of v_ref must stay: 0 < least < 1.
Penalty one_colour_diffuse(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight,
                           const Eigen::VectorXd& weight, double reference_variance, double least = 0.3);
double chroma_variance(const Eigen::MatrixX3d& diffuse, const Eigen::VectorXd& weight);

// (c) The highlight takes the colours of lips, beard and blush: with c the share of the highlight's energy (sum of
// squares) that is not grey, after division by `light_colour`, max(0, (c - most) / (2/3 - most))^2; 2/3 is a pure
// primary. Right where one light of that colour is reflected (skin mirrors without colouring); `most`, 0 <= most < 2/3,
// allows for lights that differ a little. A highlight of less than a thousandth of the picture's energy fades out of
// it.
Penalty coloured_highlight(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight,
                           const Eigen::VectorXd& weight, const Eigen::RowVector3d& light_colour = {1, 1, 1},
                           double most = 0.02);

}  // namespace faceprobe::train
