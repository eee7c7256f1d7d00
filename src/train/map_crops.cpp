#include "faceprobe/train/map_crops.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr float kMean = 0.35F;     // of a crop, as clipped
constexpr float kMostGain = 1e4F;  // beyond the gain that would do if nothing were clipped
constexpr int kMostSamples = 4;    // a side of a pixel

void check(const EnvMap& map, const MapCropOptions& options) {
  if (map.width() == 0) throw std::invalid_argument("crop of a map: there is no map");
  if (options.px < 1) throw std::invalid_argument("crop of a map: px must be 1 or more");
  if (!(options.field_of_view_rad > 0 && options.field_of_view_rad < static_cast<float>(kPi)))
    throw std::invalid_argument("crop of a map: the field of view must lie between 0 and pi");
  if (!(options.exposure > 0)) throw std::invalid_argument("crop of a map: the exposure must be above 0");
}

Eigen::Matrix3f camera_from_map(const MapCropOptions& options) {
  return (Eigen::AngleAxisf(options.pitch_rad, Eigen::Vector3f::UnitX()) *
          Eigen::AngleAxisf(options.yaw_rad, Eigen::Vector3f::UnitY()))
      .toRotationMatrix();
}

// The map's own radiance in the crop's pixels.
Image radiance_of(const EnvMap& map, const MapCropOptions& options) {
  const int px = options.px;
  const Eigen::Matrix3f map_from_camera = camera_from_map(options).transpose();
  const float half = std::tan(options.field_of_view_rad / 2);
  // As many samples as there are texels across a pixel in the middle.
  const float texels = 2 * half / static_cast<float>(px) * static_cast<float>(map.width()) / static_cast<float>(2 * kPi);
  const int samples = std::clamp(static_cast<int>(std::ceil(texels)), 1, kMostSamples);
  const int fine = px * samples;
  const float share = 1 / static_cast<float>(samples * samples);
  Image out(px, px, 3);
  for (int y = 0; y < fine; ++y) {
    for (int x = 0; x < fine; ++x) {
      const float u = (2 * static_cast<float>(x) + 1) / static_cast<float>(fine) - 1;
      const float v = 1 - (2 * static_cast<float>(y) + 1) / static_cast<float>(fine);
      Eigen::Map<Eigen::Vector3f>(out.pixel(x / samples, y / samples)) +=
          share * map.sample(map_from_camera * Eigen::Vector3f(u * half, v * half, -1));
    }
  }
  return out;
}

double clipped_mean(const Image& radiance, float gain) {
  double sum = 0;
  for (const float value : radiance.values()) sum += static_cast<double>(std::clamp(gain * value, 0.0F, 1.0F));
  return sum / static_cast<double>(radiance.values().size());
}

// By which the clipped crop's mean is kMean: a lamp in view may clip, and what it shines on is still seen.
float gain_of(const Image& radiance, float exposure) {
  double sum = 0;
  for (const float value : radiance.values()) sum += static_cast<double>(std::max(value, 0.0F));
  if (!(sum > 0)) return exposure;
  float low = static_cast<float>(static_cast<double>(kMean) * static_cast<double>(radiance.values().size()) / sum);
  float high = low * kMostGain;
  constexpr int kHalvings = 24;  // of a logarithm of 9: single precision
  for (int i = 0; i < kHalvings; ++i) {
    const float middle = std::sqrt(low) * std::sqrt(high);
    (clipped_mean(radiance, middle) < static_cast<double>(kMean) ? low : high) = middle;
  }
  return low * exposure;
}

}  // namespace

Image crop_of_map(const EnvMap& map, const MapCropOptions& options) {
  check(map, options);
  const Image radiance = radiance_of(map, options);
  return decode_srgb(encode_srgb(radiance, gain_of(radiance, options.exposure)));
}

EnvMap map_of_crop(const EnvMap& map, const MapCropOptions& options) {
  check(map, options);
  const float gain = gain_of(radiance_of(map, options), options.exposure);
  EnvMap turned = rotate(map, camera_from_map(options));
  for (float& value : turned.radiance().values()) value *= gain;
  return turned;
}

}  // namespace faceprobe::train
