#include "insert_cycles/maps.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::bench {

namespace {

constexpr int kWidth = 256;
constexpr int kHeight = 128;

struct Choice {
  const char* name;
  double azimuth_deg;  // where its brightest spot goes
};
constexpr std::array<Choice, 3> kChoices = {{{"studio_small_08", -40}, {"ulmer_muenster", 50}, {"rainforest_trail", 30}}};

double brightest_azimuth_deg(const EnvMap& map) {
  Eigen::Vector2i best(0, 0);
  const auto light = [&](int x, int y) { return luminance(map.radiance().pixel(x, y)); };
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (light(x, y) > light(best.x(), best.y())) best = {x, y};
    }
  }
  return azimuth_deg(map.direction(best.x(), best.y()).cast<double>());
}

// By whole columns, which run against the azimuth.
EnvMap turned(const EnvMap& map, double azimuth) {
  EnvMap out(map.width(), map.height());
  const auto columns = static_cast<int>(std::lround(azimuth / 360 * map.width()));
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const int to = ((x - columns) % map.width() + map.width()) % map.width();
      std::copy_n(map.radiance().pixel(x, y), 3, out.radiance().pixel(to, y));
    }
  }
  return out;
}

// As much light from the sun as from the sky, on a surface that faces it.
EnvMap sky_and_sun() {
  EnvMap map(kWidth, kHeight);
  const Eigen::Vector3f sun = direction_from_angles(-45.0, 40.0).cast<float>();
  const double radius = radians(3.0);
  const double sun_radiance = 1 / (std::sin(radius) * std::sin(radius));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool in_sun = map.direction(x, y).dot(sun) > static_cast<float>(std::cos(radius));
      std::fill_n(map.radiance().pixel(x, y), 3, in_sun ? static_cast<float>(sun_radiance) : 1.0F);
    }
  }
  return map;
}

// Nothing small and bright, so that neither renderer is left with noise to hide behind.
EnvMap soft_sky() {
  EnvMap map(kWidth, kHeight);
  const Eigen::Vector3f warm = direction_from_angles(-60.0, 30.0).cast<float>();
  const Eigen::Vector3f cool = direction_from_angles(80.0, 50.0).cast<float>();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector3f at = map.direction(x, y);
      const float a = std::max(0.0F, at.dot(warm));
      const float b = std::max(0.0F, at.dot(cool));
      float* texel = map.radiance().pixel(x, y);
      texel[0] = 0.3F + 1.5F * a * a + 0.5F * b;
      texel[1] = 0.35F + 1.2F * a * a + 0.7F * b;
      texel[2] = 0.4F + 0.9F * a * a + 1.0F * b;
    }
  }
  return map;
}

}  // namespace

std::vector<TestMap> test_maps(const std::filesystem::path& folder, int count) {
  std::vector<TestMap> maps;
  for (const Choice& choice : kChoices) {
    if (folder.empty() || static_cast<int>(maps.size()) >= count) break;
    const EnvMap map = io::read_env_map(folder / (std::string(choice.name) + ".hdr"));
    EnvMap small = resize(map, kWidth, kHeight);
    const double now = brightest_azimuth_deg(small);
    maps.push_back({choice.name, turned(small, choice.azimuth_deg - now)});
  }
  maps.push_back({"soft sky", soft_sky()});
  maps.push_back({"sky and sun", sky_and_sun()});
  return maps;
}

}  // namespace faceprobe::bench
