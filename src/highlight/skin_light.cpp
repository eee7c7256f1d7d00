#include "highlight/skin_light.h"

#include "faceprobe/core/parallel.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace faceprobe::highlight {
namespace {

constexpr std::size_t kFitBlock = 1024;  // pixels summed by one thread; blocks are added in order
constexpr float kFitWidth = 0.25F;       // relative residual at which a pixel counts half
constexpr float kTooBrightWeight = 0.3F;
constexpr double kBandRidge[3] = {1e-6, 0.006, 0.02};  // of order 0, 1, 2 against the weight of all pixels
// What a person's skin may be (deviations along the pigments) and a photo's white may be off by, in logarithms.
constexpr double kToneMelanin = 0.36;
constexpr double kToneHaemoglobin = 0.1;
constexpr double kWhite = 0.15;
constexpr float kLeastShading = 0.3F;  // of the mean light: harmonics fall below 0 where there is still light
constexpr float kLeastMirrored = 0.05F;
// From irradiance / pi to radiance by band is 1, 3/2, 4 (Ramamoorthi & Hanrahan 2001). The last is halved: it rings.
constexpr float kToRadiance[3] = {1.0F, 1.5F, 2.0F};
// More is mirrored towards the rim: what Schlick's term and the shadowing of a rough surface leave of it on training faces.
constexpr float kRimLinear = 1.6F;
constexpr float kRimSteep = 16.0F;

int band_of(int coefficient) { return coefficient == 0 ? 0 : coefficient < 4 ? 1 : 2; }
float constant_basis(const std::vector<SkinPixel>& pixels) { return pixels.front().normal_basis[0]; }

struct Normal {
  Eigen::Matrix<double, 9, 9> matrix = Eigen::Matrix<double, 9, 9>::Zero();  // lower half
  Eigen::Matrix<double, 9, 1> right = Eigen::Matrix<double, 9, 1>::Zero();
  double weight = 0;
};

Normal block_sum(const std::vector<SkinPixel>& pixels, std::size_t block, int c, bool first, const SkinLight& light) {
  Eigen::Matrix<float, 9, 9> matrix = Eigen::Matrix<float, 9, 9>::Zero();
  Harmonics right = Harmonics::Zero();
  float total = 0;
  const float darkest = 0.1F * light.shading(0, c) * constant_basis(pixels);
  for (std::size_t i = block * kFitBlock; i < std::min(pixels.size(), (block + 1) * kFitBlock); ++i) {
    const SkinPixel& pixel = pixels[i];
    if (!pixel.used[c]) continue;
    const float albedo = std::exp(light.log_skin[c] + pixel.around[c]);
    const float shading = (pixel.colour[c] - pixel.highlight * pixel.light[c]) / albedo;
    const float expected = pixel.normal_basis.dot(light.shading.col(c));
    const float scale = std::max(expected, darkest);
    const float residual = (shading - expected) / (scale * kFitWidth);
    const float trust = first ? (residual > 0 ? kTooBrightWeight : 1.0F) : 1 / (1 + residual * residual);
    // Relative to the darkest value, so that the sums do not depend on the photo's exposure.
    const float weight = trust * (darkest / scale) * (darkest / scale);
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(pixel.normal_basis, weight);
    right += (weight * shading / darkest) * pixel.normal_basis;
    total += weight;
  }
  return {matrix.cast<double>(), right.cast<double>(), static_cast<double>(total)};
}

void fit_channel(const std::vector<SkinPixel>& pixels, int c, bool first, int threads, SkinLight& light) {
  const std::size_t blocks = (pixels.size() + kFitBlock - 1) / kFitBlock;
  std::vector<Normal> parts(blocks);
  parallel_for(static_cast<int>(blocks), threads, [&](int from, int to) {
    for (int b = from; b < to; ++b)
      parts[static_cast<std::size_t>(b)] = block_sum(pixels, static_cast<std::size_t>(b), c, first, light);
  });
  Normal sum;
  for (const Normal& part : parts) {
    sum.matrix += part.matrix;
    sum.right += part.right;
    sum.weight += part.weight;
  }
  if (!(sum.weight > 0)) return;
  const auto b0 = static_cast<double>(constant_basis(pixels));
  for (int k = 0; k < 9; ++k) sum.matrix(k, k) += kBandRidge[band_of(k)] * sum.weight * b0 * b0;
  const Eigen::Matrix<double, 9, 1> fit = sum.matrix.selfadjointView<Eigen::Lower>().ldlt().solve(sum.right);
  const float before = light.shading(0, c);
  const double darkest = 0.1 * static_cast<double>(before) * b0;
  light.shading.col(c) = (darkest * fit).cast<float>();
  // The mean of the light stays above 0, whatever the pixels say.
  light.shading(0, c) = std::max(light.shading(0, c), 0.01F * before);
}

// Light and skin share what colour there is: the person's pigments take what they can, for photos are about balanced. The gain is free.
void share_colour(float b0, SkinLight& light) {
  const SkinColours skin;
  const Eigen::Vector3d melanin = kToneMelanin * skin.melanin.cast<double>();
  const Eigen::Vector3d haemoglobin = kToneHaemoglobin * skin.haemoglobin.cast<double>();
  const Eigen::Vector3f mean = light.log_skin + (b0 * light.shading.row(0).transpose()).array().log().matrix();
  Eigen::Vector3d departure = (mean - skin.mean).cast<double>();
  departure.array() -= departure.mean();
  Eigen::Matrix3d covariance = kWhite * kWhite * Eigen::Matrix3d::Identity();
  covariance += melanin * melanin.transpose() + haemoglobin * haemoglobin.transpose();
  covariance += Eigen::Matrix3d::Constant(1e4);
  const Eigen::Vector3d k = covariance.inverse() * departure;
  const Eigen::Vector3d shift = melanin.dot(k) * melanin + haemoglobin.dot(k) * haemoglobin;
  const Eigen::Vector3f log_skin = skin.mean + shift.cast<float>();
  const Eigen::Array3f factor = (light.log_skin - log_skin).array().exp();
  light.shading.array().rowwise() *= factor.transpose();
  light.log_skin = log_skin;
}

}  // namespace

SkinLight first_skin_light(const std::vector<SkinPixel>& pixels) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SkinPixel& pixel : pixels) sum += pixel.colour.cast<double>();
  const Eigen::Vector3d mean = sum / static_cast<double>(pixels.size());
  SkinLight light{ShadingModel::Zero(), SkinColours().mean};
  const Eigen::Array3f floored = mean.cwiseMax(1e-4 * mean.maxCoeff()).cast<float>().array();
  light.shading.row(0) = (floored / light.log_skin.array().exp() / constant_basis(pixels)).matrix().transpose();
  return light;
}

void fit_skin_light(const std::vector<SkinPixel>& pixels, bool first, int threads, SkinLight& light) {
  for (int c = 0; c < 3; ++c) fit_channel(pixels, c, first, threads, light);
  share_colour(constant_basis(pixels), light);
}

void light_skin(const SkinLight& light, float highlight_share, int threads, std::vector<SkinPixel>& pixels) {
  const Eigen::Vector3f mean = constant_basis(pixels) * light.shading.row(0).transpose();
  ShadingModel radiance = light.shading;
  for (int k = 0; k < 9; ++k) radiance.row(k) *= kToRadiance[band_of(k)];
  parallel_for(static_cast<int>(pixels.size()), threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      SkinPixel& pixel = pixels[static_cast<std::size_t>(i)];
      pixel.shading = (light.shading.transpose() * pixel.normal_basis).cwiseMax(kLeastShading * mean);
      const Eigen::Vector3f mirrored = (radiance.transpose() * pixel.mirror_basis).cwiseMax(kLeastMirrored * mean);
      pixel.light = mirrored / mirrored.mean();
      const float rim = 1 - pixel.facing;
      const float squared = rim * rim;
      pixel.expected_highlight =
          highlight_share * mirrored.mean() * (1 + kRimLinear * rim + kRimSteep * squared * squared * rim);
    }
  });
}

}  // namespace faceprobe::highlight
