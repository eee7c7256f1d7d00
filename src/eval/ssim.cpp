// Separable: every row of windows is first blurred down the columns, all channels side by side, then along the row. Nothing
// larger than a few rows is kept.
#include "eval/check_pictures.h"
#include "eval/row_mean.h"
#include "faceprobe/eval/image_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr int kTaps = 11;
constexpr int kRadius = kTaps / 2;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;

std::array<double, kTaps> gaussian() {
  std::array<double, kTaps> kernel;
  double sum = 0;
  for (int i = 0; i < kTaps; ++i) {
    const double at = (i - kRadius) / kSigma;
    kernel[static_cast<std::size_t>(i)] = std::exp(-0.5 * at * at);
    sum += kernel[static_cast<std::size_t>(i)];
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

// Weighted means over windows. The variances of the two pictures only appear as their sum, so four are enough. In double:
// a variance is a small difference of large numbers where layers are bright.
struct Moments {
  explicit Moments(std::size_t size) : a(size), b(size), squares(size), product(size) {}

  std::vector<double> a, b, squares, product;
};

// Row y of windows, blurred down the columns: W * C values.
void blur_columns(const Image& a, const Image& b, int y, const std::array<double, kTaps>& kernel, Moments* out) {
  const std::size_t size = out->a.size();
  for (std::vector<double>* row : {&out->a, &out->b, &out->squares, &out->product}) {
    std::fill(row->begin(), row->end(), 0.0);
  }
  for (int tap = 0; tap < kTaps; ++tap) {
    const double weight = kernel[static_cast<std::size_t>(tap)];
    const float* row_a = a.row(y + tap).data();
    const float* row_b = b.row(y + tap).data();
    for (std::size_t i = 0; i < size; ++i) {
      const double value_a = row_a[i];
      const double value_b = row_b[i];
      out->a[i] += weight * value_a;
      out->b[i] += weight * value_b;
      out->squares[i] += weight * (value_a * value_a + value_b * value_b);
      out->product[i] += weight * (value_a * value_b);
    }
  }
}

// The same along the row; neighbours are `channels` values apart.
void blur_line(const std::vector<double>& in, std::size_t channels, const std::array<double, kTaps>& kernel,
               std::vector<double>* out) {
  const double* from = in.data();
  double* to = out->data();
  for (std::size_t i = 0; i < out->size(); ++i) {
    double sum = 0;
    for (std::size_t tap = 0; tap < kTaps; ++tap) sum += kernel[tap] * from[i + tap * channels];
    to[i] = sum;
  }
}

// Equation 13 of the paper.
double similarity(const Moments& m, std::size_t i) {
  const double means = m.a[i] * m.b[i];
  const double mean_squares = m.a[i] * m.a[i] + m.b[i] * m.b[i];
  return (2 * means + kC1) * (2 * (m.product[i] - means) + kC2) /
         ((mean_squares + kC1) * (m.squares[i] - mean_squares + kC2));
}

}  // namespace

double ssim(const Image& estimate, const Image& truth, const ByteImage& mask, int threads) {
  check_pictures("ssim", estimate, truth, mask);
  const int columns = truth.width() - 2 * kRadius;  // of windows
  const int rows = truth.height() - 2 * kRadius;
  if (columns <= 0 || rows <= 0) return mean({});

  const std::array<double, kTaps> kernel = gaussian();
  const auto channels = static_cast<std::size_t>(truth.channels());
  return mean(sum_rows(rows, threads, [&](int y) {
    Moments tall(static_cast<std::size_t>(truth.width()) * channels);
    Moments whole(static_cast<std::size_t>(columns) * channels);
    blur_columns(estimate, truth, y, kernel, &tall);
    blur_line(tall.a, channels, kernel, &whole.a);
    blur_line(tall.b, channels, kernel, &whole.b);
    blur_line(tall.squares, channels, kernel, &whole.squares);
    blur_line(tall.product, channels, kernel, &whole.product);
    Partial row;
    for (int x = 0; x < columns; ++x) {
      if (!mask.empty() && mask(x + kRadius, y + kRadius) == 0) continue;
      for (std::size_t c = 0; c < channels; ++c)
        row.sum += similarity(whole, static_cast<std::size_t>(x) * channels + c);
      row.count += truth.channels();
    }
    return row;
  }));
}

}  // namespace faceprobe::eval
