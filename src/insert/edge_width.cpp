#include "insert/edge_width.h"

#include "faceprobe/insert/photo_look.h"

#include <cmath>
#include <cstddef>

namespace faceprobe::insert {
namespace {

constexpr std::array<float, 3> kBlurs = {0.7F, 1.5F, 2.2F};
constexpr double kAgree = 0.2;

Gradient gradient_of(const Image& picture) {
  const int width = picture.width();
  const int height = picture.height();
  Gradient gradient{Image(width, height, 1), Image(width, height, 1), Image(width, height, 1)};
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const float across = (picture(x + 1, y) - picture(x - 1, y)) / 2;
      const float down = (picture(x, y + 1) - picture(x, y - 1)) / 2;
      gradient.across(x, y) = across;
      gradient.down(x, y) = down;
      gradient.size(x, y) = std::sqrt(across * across + down * down);
    }
  }
  return gradient;
}

// Height of the ridge between the pixels: a parabola through the logarithms, exact for a Gaussian.
std::optional<double> peak(const Image& size, int x, int y, const Step& step) {
  const auto log_at = [&](int k) { return std::log(static_cast<double>(size(x + k * step.x, y + k * step.y)) + 1e-12); };
  const double curve = (log_at(1) + log_at(-1)) / 2 - log_at(0);
  const double slope = (log_at(1) - log_at(-1)) / 2;
  if (!(curve < 0) || std::abs(slope) > -2 * curve) return std::nullopt;  // the top is more than a pixel away
  return std::exp(log_at(0) - slope * slope / (4 * curve));
}

// A central difference is a box two pixels wide along its axis, one third of variance; seen across the edge it is narrower.
double variance_of_difference(const Gradient& gradient, int x, int y) {
  const double across = std::pow(static_cast<double>(gradient.across(x, y)), 2);
  const double down = std::pow(static_cast<double>(gradient.down(x, y)), 2);
  return (across * across + down * down) / (3 * (across + down) * (across + down));
}

}  // namespace

Gradients blurred_gradients(const Image& luminance) {
  Gradients gradients;
  for (std::size_t i = 0; i < kBlurs.size(); ++i) gradients[i] = gradient_of(blur(luminance, kBlurs[i]));
  return gradients;
}

Step across_edge(const Gradient& gradient, int x, int y) {
  return std::abs(gradient.across(x, y)) >= std::abs(gradient.down(x, y)) ? Step{1, 0} : Step{0, 1};
}

std::optional<double> step_variance(const Gradients& gradients, int x, int y) {
  const Step step = across_edge(gradients[1], x, y);
  std::array<double, kBlurs.size()> squares{};
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto height = peak(gradients[i].size, x, y, step);
    if (!height) return std::nullopt;
    squares[i] = *height * *height;
  }
  const auto total = [&](std::size_t i) {  // with the first blur's
    const double more = static_cast<double>(kBlurs[i] * kBlurs[i] - kBlurs[0] * kBlurs[0]);
    return more / (squares[0] / squares[i] - 1);
  };
  if (!(squares[0] > squares[1] && squares[1] > squares[2])) return std::nullopt;
  if (std::abs(total(1) / total(2) - 1) > kAgree) return std::nullopt;
  const double own = static_cast<double>(kBlurs[0] * kBlurs[0]) + variance_of_difference(gradients[1], x, y);
  return total(2) - own;
}

}  // namespace faceprobe::insert
