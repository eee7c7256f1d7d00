#include "faceprobe/synth/mixed_maps.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/synth/map_light.h"
#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::synth {
namespace {

double mean_luminance(const EnvMap& map) { return map.integral().dot(kLuminanceWeights.cast<double>()) / (4 * kPi); }

std::vector<NamedMap> two_maps() {
  EnvMap sunny = sky(64);
  add_lamp(sunny, Eigen::Vector3f(1, 1, 1).normalized(), 8, {90, 80, 60});
  return {{"sky", sky(128)}, {"sunny", sunny}};
}

TEST(MixedMaps, AreOfMeanOneAndNamedAfterBoth) {
  const std::vector<NamedMap> mixed = mixed_maps(two_maps(), {.count = 12, .seed = 3});
  ASSERT_EQ(mixed.size(), 12U);
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const auto& [name, map] = mixed[i];
    EXPECT_NEAR(mean_luminance(map), 1, 1e-5);  // float storage
    EXPECT_NE(name.find('+'), std::string::npos) << name;
    EXPECT_TRUE(name.ends_with("#" + std::to_string(i))) << name;
    // What generation asks of a map.
    EXPECT_NO_THROW(prepare_map(name, map, {}));
  }
}

TEST(MixedMaps, DependOnSeedAndNumberAlone) {
  const std::vector<NamedMap> few = mixed_maps(two_maps(), {.count = 3, .seed = 3});
  const std::vector<NamedMap> many = mixed_maps(two_maps(), {.count = 6, .seed = 3});
  const std::vector<NamedMap> others = mixed_maps(two_maps(), {.count = 3, .seed = 4});
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].second.radiance(), many[i].second.radiance());
    EXPECT_NE(few[i].second.radiance(), others[i].second.radiance());
  }
}

// One map, no second, no contrast, no lamps: what comes out is the map, scaled.
TEST(MixedMaps, WithoutChangesAreTheMap) {
  const std::vector<NamedMap> one = {{"sky", sky(64)}};
  const std::vector<NamedMap> mixed = mixed_maps(one, {.count = 2, .seed = 1, .second = 0, .contrast = 0, .lamps = 0});
  const double level = mean_luminance(one[0].second);
  for (const auto& [name, map] : mixed) {
    for (std::size_t i = 0; i < map.radiance().values().size(); ++i) {
      const double expected = static_cast<double>(one[0].second.radiance().data()[i]) / level;
      ASSERT_NEAR(static_cast<double>(map.radiance().data()[i]), expected, 1e-5 * (1 + expected));
    }
  }
}

// A map mixed with itself, turned or mirrored, keeps the energy of every row, whatever the turn and the share.
TEST(MixedMaps, TurnsKeepTheEnergyOfEveryRow) {
  const std::vector<NamedMap> one = {two_maps()[1]};
  const auto row_sum = [](const EnvMap& map, int y) {
    double sum = 0;
    for (int x = 0; x < map.width(); ++x) sum += static_cast<double>(map.radiance()(x, y, 1));
    return sum;
  };
  const double level = mean_luminance(one[0].second);
  for (const auto& [name, map] : mixed_maps(one, {.count = 8, .seed = 2, .second = 1, .contrast = 0, .lamps = 0})) {
    for (int y = 0; y < map.height(); ++y) {
      const double expected = row_sum(one[0].second, y) / level;
      ASSERT_NEAR(row_sum(map, y), expected, 1e-5 * expected);  // float storage
    }
  }
}

// With a lamp in every mixture of an even sky, the brightest texels stand above the rest.
TEST(MixedMaps, LampsAreAdded) {
  EnvMap even(64, 32);
  for (float& value : even.radiance().values()) value = 1;
  const std::vector<NamedMap> one = {{"even", even}};
  for (const auto& [name, map] : mixed_maps(one, {.count = 8, .seed = 5, .lamps = 1})) {
    const auto [low, high] = std::ranges::minmax(map.radiance().values());
    EXPECT_GT(high, 1.5F * low) << name;
  }
}

TEST(MixedMaps, RefuseWhatCannotBeMixed) {
  const std::vector<NamedMap> maps = two_maps();
  EXPECT_THROW(mixed_maps(maps, {.count = -1}), std::invalid_argument);
  EXPECT_THROW(mixed_maps(maps, {.count = 1, .second = 2}), std::invalid_argument);
  const std::vector<NamedMap> black = {{"black", EnvMap(16, 8)}};
  EXPECT_THROW(mixed_maps(black, {.count = 1}), Error);
  EXPECT_TRUE(mixed_maps({}, {.count = 5}).empty());
}

}  // namespace
}  // namespace faceprobe::synth
