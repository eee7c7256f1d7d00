#include "train/sky_examples.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/sky.h"
#include "net/torch/sky_cnn.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace faceprobe::train {
namespace {

constexpr int kFitNside = 16;
constexpr int kMapWidth = 512;  // a texel is then as wide as a pixel of a usual crop
constexpr double kLeastExposure = 1e-4;

struct Place {
  std::size_t map = 0;  // its number in the list
  EnvMap small;
  SkyParameters sky;
};

SkyParameters sky_of(const NamedMap& map) {
  const SphereGrid grid(kFitNside);
  try {
    return lighting::fit_sky(grid_from_env_map(map.second, grid).cwiseMax(0.0F), grid).sky;
  } catch (const std::invalid_argument& problem) {
    throw Error(ExitCode::kInput, "No sky can be fitted to the map " + map.first + " (" + problem.what() +
                                      "). Leave it out, or name outdoor maps only.");
  }
}

EnvMap small_map(const EnvMap& map) { return map.width() > kMapWidth ? resize(map, kMapWidth, kMapWidth / 2) : map; }

MapCropOptions drawn_sky_view(const SkyConfig& config, Random random) {
  MapCropOptions view;
  view.px = config.px;
  view.field_of_view_rad = static_cast<float>(radians(random.between(config.least_view_deg, config.most_view_deg)));
  view.yaw_rad = static_cast<float>(random.between(-kPi, kPi));
  view.pitch_rad = static_cast<float>(radians(random.between(-config.most_pitch_deg, config.most_pitch_deg)));
  view.exposure = static_cast<float>(std::exp(random.normal(0, config.exposure_spread)));
  return view;
}

Eigen::Matrix3f level_from_map(const MapCropOptions& view) {
  return Eigen::AngleAxisf(view.yaw_rad, Eigen::Vector3f::UnitY()).toRotationMatrix();
}

Eigen::Matrix3f camera_from_level(const MapCropOptions& view) {
  return Eigen::AngleAxisf(view.pitch_rad, Eigen::Vector3f::UnitX()).toRotationMatrix();
}

void fill(const Place& place, const MapCropOptions& view, std::uint8_t* picture, float* sun, float* numbers) {
  const Image crop = crop_of_map(place.small, view);
  std::ranges::copy(encode_srgb(crop).values(), picture);
  Eigen::Map<Eigen::Vector3f>(sun, 3) = level_from_map(view) * sun_direction(place.sky).cast<float>();
  const double gain = gain_of_crop(place.small, view, crop);
  const double sunlight = sun_irradiance(place.sky).dot(luminance_weights<double>());
  const auto set = [&](net::SkyNumber which, double value) {
    numbers[static_cast<int>(which)] = static_cast<float>(value);
  };
  set(net::SkyNumber::kTurbidity, place.sky.turbidity);
  set(net::SkyNumber::kLogExposure, std::log(std::max(kLeastExposure, gain * place.sky.exposure)));
  set(net::SkyNumber::kCameraElevation, static_cast<double>(-view.pitch_rad));
  set(net::SkyNumber::kFieldOfView, static_cast<double>(view.field_of_view_rad));
  set(net::SkyNumber::kLogSunlight, std::log(net::kLeastSunlight + gain * sunlight));
}

}  // namespace

double gain_of_crop(const EnvMap& map, const MapCropOptions& view, const Image& crop) {
  constexpr int kStep = 4;  // pixels: some hundreds are enough
  constexpr float kDark = 0.05F;
  constexpr float kBright = 0.95F;
  const Eigen::Matrix3f map_from_camera = (camera_from_level(view) * level_from_map(view)).transpose();
  const float half = std::tan(view.field_of_view_rad / 2);
  std::vector<double> gains;
  for (int y = 0; y < crop.height(); y += kStep) {
    for (int x = 0; x < crop.width(); x += kStep) {
      const float green = crop(x, y, 1);
      if (green < kDark || green > kBright) continue;
      const auto offset = [half](int i, int size) {
        return half * ((2 * static_cast<float>(i) + 1) / static_cast<float>(size) - 1);
      };
      const float there =
          map.sample(map_from_camera * Eigen::Vector3f(offset(x, crop.width()), -offset(y, crop.height()), -1)).y();
      if (there > 0) gains.push_back(static_cast<double>(green / there));
    }
  }
  return gains.empty() ? 1 : upper_median_of(std::move(gains));
}

SkyExamples draw_sky_examples(const std::vector<NamedMap>& maps, const SkyConfig& config, std::uint64_t purpose,
                              int threads) {
  SkyExamples out;
  std::vector<Place> places;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    places.push_back({i, small_map(maps[i].second), sky_of(maps[i])});
    out.ground_albedo += places.back().sky.ground_albedo;
  }
  if (places.empty()) return out;
  out.ground_albedo /= static_cast<double>(places.size());
  const int count = static_cast<int>(places.size()) * config.crops_per_map;
  out.pictures = torch::empty({count, config.px, config.px, 3}, torch::kByte);
  out.sun = torch::empty({count, 3});
  out.numbers = torch::empty({count, net::kSkyNumbers});
  std::uint8_t* const pictures = out.pictures.data_ptr<std::uint8_t>();
  float* const suns = out.sun.data_ptr<float>();
  float* const numbers = out.numbers.data_ptr<float>();
  const std::ptrdiff_t bytes = std::ptrdiff_t{3} * config.px * config.px;
  parallel_for(count, threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Place& place = places[static_cast<std::size_t>(i / config.crops_per_map)];
      const Random random({config.seed, purpose, place.map, static_cast<std::uint64_t>(i % config.crops_per_map)});
      fill(place, drawn_sky_view(config, random), pictures + i * bytes, suns + std::ptrdiff_t{3} * i,
           numbers + std::ptrdiff_t{net::kSkyNumbers} * i);
    }
  });
  return out;
}

}  // namespace faceprobe::train
