#include "train/chromaticity.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {

namespace {

constexpr float kMaxSigmaPx = 100;

// Half of a Gaussian with its centre, cut at three sigma. Not normalised: the weights do that.
std::vector<double> gaussian(double sigma_px) {
  std::vector<double> kernel;
  if (!(sigma_px > 0)) return kernel;
  const int radius = static_cast<int>(std::ceil(3 * sigma_px));
  for (int i = 0; i <= radius; ++i) kernel.push_back(std::exp(-0.5 * (i / sigma_px) * (i / sigma_px)));
  return kernel;
}

// Convolution along lines of `length` values that are `step` apart; zero beyond the ends, which makes it its own
// adjoint.
void blur_line(const std::vector<double>& kernel, double* first, Eigen::Index step, int length,
               std::vector<double>* copy) {
  copy->resize(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) (*copy)[static_cast<std::size_t>(i)] = first[i * step];
  const int radius = static_cast<int>(kernel.size()) - 1;
  for (int i = 0; i < length; ++i) {
    double sum = 0;
    for (int k = std::max(0, i - radius); k <= std::min(length - 1, i + radius); ++k) {
      sum += kernel[static_cast<std::size_t>(std::abs(k - i))] * (*copy)[static_cast<std::size_t>(k)];
    }
    first[i * step] = sum;
  }
}

}  // namespace

std::string ChromaticityOptions::validate() const {
  if (!(floor > 0) || !std::isfinite(floor)) return "floor must be positive.";
  if (!(blur_sigma_px >= 0) || blur_sigma_px > kMaxSigmaPx) return "blur_sigma_px must be from 0 to 100.";
  return {};
}

Chromaticity::Chromaticity(const Image& weight, const ChromaticityOptions& options)
    : width_(weight.width()), height_(weight.height()), floor_(static_cast<double>(options.floor)),
      kernel_(gaussian(static_cast<double>(options.blur_sigma_px))) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (weight.channels() != 1) throw std::invalid_argument("The weights of a mask have one channel.");
  std::vector<double> weights;
  for (std::size_t i = 0; i < weight.pixel_count(); ++i) {
    const float w = weight.data()[i];
    if (!(w >= 0) || !std::isfinite(w))
      throw std::invalid_argument("The weights of a mask are finite and not negative.");
    if (w == 0) continue;
    inside_.push_back(static_cast<Eigen::Index>(i));
    weights.push_back(static_cast<double>(w));
  }
  if (inside_.empty()) throw std::invalid_argument("A mask needs a pixel with weight.");
  weight_ = Eigen::Map<const Eigen::VectorXd>(weights.data(), pixels());
  // Its own centre is in every sum, so none of these is 0.
  reached_ = spread(weight_.replicate<1, 2>()).col(0);
}

// `values` at the pixels of the mask, 0 elsewhere, convolved and read at the pixels of the mask. Symmetric.
Eigen::MatrixX2d Chromaticity::spread(const Eigen::MatrixX2d& values) const {
  if (kernel_.empty()) return values;
  Eigen::MatrixX2d result(values.rows(), 2);
  Eigen::VectorXd plane(static_cast<Eigen::Index>(width_) * height_);
  std::vector<double> line;
  for (int c = 0; c < 2; ++c) {
    plane.setZero();
    for (Eigen::Index i = 0; i < pixels(); ++i) plane(inside_[static_cast<std::size_t>(i)]) = values(i, c);
    for (int y = 0; y < height_; ++y) {
      blur_line(kernel_, plane.data() + static_cast<Eigen::Index>(y) * width_, 1, width_, &line);
    }
    for (int x = 0; x < width_; ++x) blur_line(kernel_, plane.data() + x, width_, height_, &line);
    for (Eigen::Index i = 0; i < pixels(); ++i) result(i, c) = plane(inside_[static_cast<std::size_t>(i)]);
  }
  return result;
}

void Chromaticity::check(Eigen::Index rows) const {
  if (rows != static_cast<Eigen::Index>(width_) * height_) {
    throw std::invalid_argument("The diffuse picture has not the size of the mask.");
  }
}

Eigen::RowVectorXd Chromaticity::row(const Eigen::Ref<const Eigen::MatrixX3d>& diffuse) const {
  check(diffuse.rows());
  Eigen::MatrixX2d weighted(pixels(), 2);
  for (Eigen::Index i = 0; i < pixels(); ++i) {
    const Eigen::RowVector3d rgb = diffuse.row(inside_[static_cast<std::size_t>(i)]).cwiseMax(0.0);
    weighted.row(i) = weight_(i) / std::max(rgb.sum(), floor_) * rgb.head<2>();
  }
  // sqrt(w) / reached * (kernel convolved with w c); without a blur, reached = w.
  const Eigen::MatrixX2d blurred = spread(weighted).array().colwise() * (weight_.array().sqrt() / reached_.array());
  return Eigen::Map<const Eigen::RowVectorXd>(blurred.data(), blurred.size());
}

Eigen::MatrixX3d Chromaticity::backward(const Eigen::Ref<const Eigen::MatrixX3d>& diffuse,
                                        const Eigen::RowVectorXd& by_row) const {
  check(diffuse.rows());
  if (by_row.size() != 2 * pixels()) throw std::invalid_argument("The gradient has not the length of the row.");
  const Eigen::Map<const Eigen::MatrixX2d> by_blurred(by_row.data(), pixels(), 2);
  const Eigen::MatrixX2d by_weighted =
      spread(by_blurred.array().colwise() * (weight_.array().sqrt() / reached_.array()));
  Eigen::MatrixX3d gradient = Eigen::MatrixX3d::Zero(diffuse.rows(), 3);
  for (Eigen::Index i = 0; i < pixels(); ++i) {
    const Eigen::Index pixel = inside_[static_cast<std::size_t>(i)];
    const Eigen::RowVector3d rgb = diffuse.row(pixel).cwiseMax(0.0);
    const Eigen::RowVector2d by_chroma = weight_(i) * by_weighted.row(i);
    const double total = std::max(rgb.sum(), floor_);
    // c = rgb / total: d c / d rgb = (identity - c 1^T) / total, and without the second term where the floor stands in
    // for the sum.
    const double through_sum = rgb.sum() > floor_ ? by_chroma.dot(rgb.head<2>()) / total : 0.0;
    for (int c = 0; c < 3; ++c) {
      if (diffuse(pixel, c) > 0) gradient(pixel, c) = ((c < 2 ? by_chroma(c) : 0.0) - through_sum) / total;
    }
  }
  return gradient;
}

Eigen::MatrixX3d matrix_from_picture(const Image& picture) {
  if (picture.channels() != 3) throw std::invalid_argument("A diffuse picture has three channels.");
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(picture.data(), static_cast<Eigen::Index>(picture.pixel_count()), 3).cast<double>();
}

Image picture_from_matrix(const Eigen::Ref<const Eigen::MatrixX3d>& matrix, int width, int height) {
  if (matrix.rows() != static_cast<Eigen::Index>(width) * height) {
    throw std::invalid_argument("The matrix has not the size of the picture.");
  }
  Image picture(width, height, 3);
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  Eigen::Map<Rows>(picture.data(), matrix.rows(), 3) = matrix.cast<float>();
  return picture;
}

}  // namespace faceprobe::train
