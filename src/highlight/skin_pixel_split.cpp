#include "highlight/skin_pixel_split.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace faceprobe::highlight {
namespace {

constexpr int kNewtonSteps = 3;    // of Newton; rounds go on where the one before ended
constexpr float kLongestStep = 1;  // in the logarithm
constexpr float kMost = 0.97F;     // of the smallest channel that a highlight may take: skin is not black
constexpr float kNoiseShare = 0.04F;
constexpr float kUnused = 1e4F;  // variance of a channel that does not count

// Of log(colour - highlight) from what is expected there, and its derivative by the logarithm of the highlight.
struct Residual {
  Eigen::Vector3f value = Eigen::Vector3f::Zero();
  Eigen::Vector3f slope = Eigen::Vector3f::Zero();
};

Residual residual_at(const SkinPixel& pixel, const Eigen::Vector3f& expected, float highlight) {
  Residual residual;
  for (int c = 0; c < 3; ++c) {
    if (!pixel.used[c]) continue;
    const float rest = pixel.colour[c] - highlight * pixel.light[c];
    residual.value[c] = std::log(rest) - expected[c];
    residual.slope[c] = -highlight * pixel.light[c] / rest;
  }
  return residual;
}

}  // namespace

PixelPriors::PixelPriors(const SkinSubspaceOptions& options, float level)
    : explained(Eigen::Matrix3f::Constant(options.shading_deviation * options.shading_deviation)),
      unexplained(options.colour_deviation * options.colour_deviation), noise(kNoiseShare * level),
      log_ratio_precision(1 / (options.highlight_deviation * options.highlight_deviation)) {
  const SkinColours skin;
  const Eigen::Vector3f melanin = options.melanin_deviation * skin.melanin;
  const Eigen::Vector3f haemoglobin = options.haemoglobin_deviation * skin.haemoglobin;
  explained += melanin * melanin.transpose() + haemoglobin * haemoglobin.transpose();
}

void split_pixel(const PixelPriors& priors, const Eigen::Vector3f& log_skin, SkinPixel& pixel) {
  if (!pixel.seen()) {
    pixel.highlight = 0;
    pixel.own = pixel.around;
    return;
  }
  Eigen::Matrix3f covariance = priors.explained;
  float most = 0;
  for (int c = 0; c < 3; ++c) {
    covariance(c, c) += priors.unexplained;
    if (!pixel.used[c]) {
      covariance(c, c) += kUnused;
      continue;
    }
    const float relative = priors.noise / pixel.colour[c];
    covariance(c, c) += std::min(relative * relative, kUnused);
    const float whole = pixel.colour[c] / pixel.light[c];
    most = most > 0 ? std::min(most, whole) : whole;
  }
  most *= kMost;
  const Eigen::Matrix3f precision = covariance.inverse();
  const Eigen::Vector3f expected = pixel.shading.array().log().matrix() + log_skin + pixel.around;
  const float highest = std::log(most / pixel.expected_highlight);
  float ratio = std::min(pixel.log_ratio, highest);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const float highlight = std::min(most, pixel.expected_highlight * std::exp(ratio));
    const Residual residual = residual_at(pixel, expected, highlight);
    const Eigen::Vector3f weighted = precision * residual.slope;
    const float gradient = weighted.dot(residual.value) + priors.log_ratio_precision * ratio;
    const float curvature = weighted.dot(residual.slope) + priors.log_ratio_precision;
    ratio = std::min(highest, ratio - std::clamp(gradient / curvature, -kLongestStep, kLongestStep));
  }
  pixel.log_ratio = ratio;
  pixel.highlight = std::min(most, pixel.expected_highlight * std::exp(ratio));
  const Residual residual = residual_at(pixel, expected, pixel.highlight);
  pixel.own = pixel.around + priors.explained * (precision * residual.value);
}

}  // namespace faceprobe::highlight
