#pragma once
// From a diffuse picture to its row of the low-rank loss's matrix, and back: chromaticity (r, g) / (r + g + b) inside a
// mask (Equation 1 of the paper), blurred inside the mask if wanted, and the exact vector-Jacobian product of all that.
//
// Pictures here are matrices in double, one row per pixel (pixel (x, y) is row y * width + x) and one column per
// channel, linear light. That is how a 3 x height x width tensor of doubles lies in memory, so that an Eigen::Map of
// one needs no copy.
//
//   const Chromaticity chromaticity(weight, {.blur_sigma_px = 2.5F});  // one weight for all photos of a person
//   for (int k = 0; k < photos; ++k) d.row(k) = chromaticity.row(diffuse[k]);
//   const LowRankLoss loss = distance_to_rank1(d, chromaticity.weight_sum());
//   for (int k = 0; k < photos; ++k) by_diffuse[k] = chromaticity.backward(diffuse[k], loss.gradient.row(k));
//
// Not for photos whose masks differ: a pixel that one of them does not see must have weight 0 for all, because the rows
// share their columns.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace faceprobe::train {

struct ChromaticityOptions {
  // A sum r + g + b below this is replaced by it, so that chromaticity falls to 0 with the light instead of becoming
  // the noise of the darkest codes: .005 is code 5 or 6 of 255 in each channel, where one code more is a fifth of the
  // value. 1 = the photo's white.
  float floor = 0.005F;
  // Of the Gaussian; 0 = none. 2 to 3 take out what landmarks misplace, which would otherwise stay at every edge as a
  // rank of its own.
  float blur_sigma_px = 0;

  std::string validate() const;  // empty when usable
};

class Chromaticity {
 public:
  // `weight`: height x width x 1, >= 0, 0 = not in the mask. A column of D gets the root of its pixel's weight, so that
  // squares of D are weighted by it. Throws std::invalid_argument: options, no pixel with weight, negative or
  // non-finite weights.
  explicit Chromaticity(const Image& weight, const ChromaticityOptions& options = {});

  Eigen::Index pixels() const { return static_cast<Eigen::Index>(inside_.size()); }  // with weight > 0
  double weight_sum() const { return weight_.sum(); }

  // 1 x 2 pixels(): first all r, then all g, pixels in row-major order. Channels below 0 count as 0. The blur is a
  // convolution normalised by the weights (Knutsson & Westin 1993): what is outside the mask takes no part. `diffuse`:
  // width * height x 3. Throws std::invalid_argument when the size is another.
  Eigen::RowVectorXd row(const Eigen::Ref<const Eigen::MatrixX3d>& diffuse) const;

  // The gradient by the diffuse picture, given that by the row: the transposed Jacobian at `diffuse` times `by_row`. 0
  // outside the mask and for channels at or below 0.
  Eigen::MatrixX3d backward(const Eigen::Ref<const Eigen::MatrixX3d>& diffuse, const Eigen::RowVectorXd& by_row) const;

 private:
  Eigen::MatrixX2d spread(const Eigen::MatrixX2d& values) const;
  void check(Eigen::Index rows) const;

  int width_ = 0;
  int height_ = 0;
  double floor_ = 0;
  std::vector<Eigen::Index> inside_;  // pixel numbers
  Eigen::VectorXd weight_;            // of those
  Eigen::VectorXd reached_;           // the weights themselves, blurred; what the blur is divided by
  std::vector<double> kernel_;        // one half with its centre; empty = no blur
};

// Between a three-channel picture and the matrix above.
Eigen::MatrixX3d matrix_from_picture(const Image& picture);
Image picture_from_matrix(const Eigen::Ref<const Eigen::MatrixX3d>& matrix, int width, int height);

}  // namespace faceprobe::train
