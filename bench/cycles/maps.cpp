#include "cycles/maps.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::bench {

namespace {

struct Choice {
  const char* name;
  const char* kind;
  double azimuth_deg;  // where its brightest spot goes
};
// Every second one first, so that fewer maps still span the range.
constexpr std::array<Choice, 8> kChoices = {{{"kloofendal_overcast", "overcast", 30},
                                             {"quarry_02", "sun", 50},
                                             {"lebombo", "room", -40},
                                             {"studio_small_03", "studio", 35},
                                             {"phalzer_forest_01", "overcast", -35},
                                             {"limpopo_golf_course", "sun", -45},
                                             {"st_fagans_interior", "room", 55},
                                             {"brown_photostudio_02", "studio", -60}}};

double luminance(const Image& image, int x, int y) {
  const float* rgb = image.pixel(x, y);
  return faceprobe::luminance(static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2]));
}

EnvMap rolled(const EnvMap& map, int columns) {
  EnvMap out(map.width(), map.height());
  const int width = map.width();
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c)
        out.radiance()(((x + columns) % width + width) % width, y, c) = map.radiance()(x, y, c);
    }
  }
  return out;
}

Eigen::Vector2i brightest(const EnvMap& map) {
  Eigen::Vector2i best(0, 0);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (luminance(map.radiance(), x, y) > luminance(map.radiance(), best.x(), best.y())) best = {x, y};
    }
  }
  return best;
}

void describe(NamedMap& map) {
  const Eigen::Vector2i peak = brightest(map.radiance);
  const Eigen::Vector3d direction = map.radiance.direction(peak.x(), peak.y()).cast<double>();
  const Eigen::Vector3d mean = map.radiance.integral() / (4 * kPi);
  map.peak_over_mean = luminance(map.radiance.radiance(), peak.x(), peak.y()) / faceprobe::luminance(mean.data());
  map.peak_azimuth_deg = azimuth_deg(direction);
  map.peak_elevation_deg = elevation_deg(direction);
}

}  // namespace

std::vector<NamedMap> load_maps(const std::filesystem::path& data, int count) {
  std::vector<NamedMap> maps;
  for (int i = 0; i < std::min(count, static_cast<int>(kChoices.size())); ++i) {
    const Choice& choice = kChoices[static_cast<std::size_t>(i)];
    NamedMap map{choice.name, choice.kind,
                 0,           0,
                 0,           io::read_env_map(data / "hdri" / "train" / (std::string(choice.name) + ".hdr"))};
    const Eigen::Vector2i peak = brightest(map.radiance);
    const double now = azimuth_deg(map.radiance.direction(peak.x(), peak.y()).cast<double>());
    // Columns run against the azimuth: the centre is +z, a quarter of the width is +x.
    map.radiance =
        rolled(map.radiance, static_cast<int>(std::lround((now - choice.azimuth_deg) / 360.0 * map.radiance.width())));
    describe(map);
    maps.push_back(std::move(map));
  }
  return maps;
}

NamedMap red_lamp(int height) {
  NamedMap map{"red lamp", "lamp", 0, 0, 0, EnvMap(2 * height, height)};
  const Eigen::Vector3f right = direction_from_angles(75.0, 10.0).cast<float>();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      const bool lamp = map.radiance.direction(x, y).dot(right) > std::cos(static_cast<float>(radians(6.0)));
      for (int c = 0; c < 3; ++c) map.radiance.radiance()(x, y, c) = lamp && c == 0 ? 60.0F : 0.1F;
    }
  }
  describe(map);
  return map;
}

}  // namespace faceprobe::bench
