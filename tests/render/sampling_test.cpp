#include "chi_square.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/random.h"
#include "render/map_sampler.h"
#include "render/sobol.h"

#include <gtest/gtest.h>

#include <set>

namespace faceprobe::render {
namespace {

TEST(Sobol, EverySliceOfEqualAreaHoldsOneSample) {
  // A (0, 4, 2)-net: 16 samples, in each of the 16 boxes of every shape.
  for (std::uint32_t key = 0; key < 5; ++key) {
    for (int columns = 1; columns <= 16; columns *= 2) {
      const int rows = 16 / columns;
      for (int dimension = 0; dimension < 4; ++dimension) {
        std::set<int> boxes;
        for (std::uint32_t s = 0; s < 16; ++s) {
          SobolSampler random(key, s);
          for (int skipped = 0; skipped < dimension; ++skipped) random.pair();
          const Eigen::Vector2f at = random.pair();
          boxes.insert(static_cast<int>(at.x() * static_cast<float>(columns)) * rows +
                       static_cast<int>(at.y() * static_cast<float>(rows)));
        }
        EXPECT_EQ(boxes.size(), 16U) << key << ' ' << columns << ' ' << dimension;
      }
    }
  }
}

TEST(Sobol, PairsAndKeysAreUnrelated) {
  // Correlation of 4096 independent pairs has a standard deviation of 1 / 64.
  double pairs = 0;
  double keys = 0;
  for (std::uint32_t s = 0; s < 4096; ++s) {
    SobolSampler a(1, s);
    SobolSampler b(2, s);
    const Eigen::Vector2f first = a.pair();
    pairs += (first.x() - 0.5) * (a.pair().x() - 0.5);
    keys += (first.x() - 0.5) * (b.pair().x() - 0.5);
  }
  EXPECT_LT(std::abs(pairs / 4096 * 12), 4.0 / 64);
  EXPECT_LT(std::abs(keys / 4096 * 12), 4.0 / 64);
}

EnvMap map_with(int height, const std::function<float(int, int)>& value) {
  EnvMap map(2 * height, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = value(x, y);
    }
  }
  return map;
}

// What look() says will be drawn in a texel, by 16 x 16 points.
double expected_share(const MapSampler& sampler, const EnvMap& map, int x, int y) {
  constexpr int kPoints = 16;
  double sum = 0;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const Eigen::Vector2f uv(
        (static_cast<float>(x) + (static_cast<float>(i % kPoints) + 0.5F) / kPoints) / static_cast<float>(map.width()),
        (static_cast<float>(y) + (static_cast<float>(i / kPoints) + 0.5F) / kPoints) / static_cast<float>(map.height()));
    sum += sampler.look(direction_from_uv(uv)).density * solid_angle_density(uv.y());
  }
  return sum / (kPoints * kPoints) / static_cast<double>(map.radiance().pixel_count());
}

double texel_p(const EnvMap& map) {
  const MapSampler sampler(map);
  Random random({11});
  constexpr int kDraws = 200000;
  std::vector<double> counts(map.radiance().pixel_count());
  std::vector<double> expected(counts.size());
  for (int i = 0; i < kDraws; ++i) {
    const MapSampler::Seen seen =
        sampler.draw({static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
    const Eigen::Vector2f uv = uv_from_direction(seen.direction);
    const int x = std::min(static_cast<int>(uv.x() * static_cast<float>(map.width())), map.width() - 1);
    const int y = std::min(static_cast<int>(uv.y() * static_cast<float>(map.height())), map.height() - 1);
    counts[static_cast<std::size_t>(y * map.width() + x)] += 1;
  }
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x)
      expected[static_cast<std::size_t>(y * map.width() + x)] = kDraws * expected_share(sampler, map, x, y);
  }
  return testing::chi_square_p(counts, expected);
}

TEST(MapSampler, DrawsAsItsDensitySays) {
  Random random({3});
  EXPECT_GT(texel_p(map_with(32, [](int x, int y) { return x == 9 && y == 12 ? 100.0F : 0.0F; })), 0.01);
  EXPECT_GT(texel_p(map_with(32, [](int, int) { return 0.7F; })), 0.01);
  EXPECT_GT(texel_p(map_with(1, [](int x, int) { return 1.0F + static_cast<float>(x); })), 0.01);
  EXPECT_GT(texel_p(map_with(3, [](int x, int y) { return static_cast<float>(x * y); })), 0.01);
  EXPECT_GT(texel_p(map_with(17, [&](int, int) { return static_cast<float>(std::exp(3 * random.normal())); })), 0.01);
}

TEST(MapSampler, DensityOverTheSphereIsOne) {
  Random random({4});
  const EnvMap map = map_with(20, [&](int, int) { return static_cast<float>(std::exp(2 * random.normal())); });
  const MapSampler sampler(map);
  double sum = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) sum += expected_share(sampler, map, x, y);
  }
  EXPECT_NEAR(sum, 1, 1e-4);  // the points are exact for tents; angles are single precision
}

TEST(MapSampler, LooksUpWhatTheMapHolds) {
  Random random({5});
  const EnvMap map = map_with(16, [&](int, int) { return static_cast<float>(random.uniform()); });
  const MapSampler sampler(map);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f direction = random.direction();
    // Single-precision angles: 1e-6 of a turn, times 32 columns.
    EXPECT_NEAR(sampler.look(direction).radiance.x(), map.sample(direction).x(), 2e-4F);
    const MapSampler::Seen drawn =
        sampler.draw({static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
    EXPECT_NEAR(drawn.direction.norm(), 1, 1e-5F);
    EXPECT_NEAR(drawn.radiance.x(), map.sample(drawn.direction).x(), 2e-4F);
  }
}

TEST(MapSampler, BlackMapIsDrawnFromEvenly) {
  const MapSampler sampler(EnvMap(8, 4));
  const MapSampler::Seen seen = sampler.draw({0.3F, 0.6F});
  EXPECT_EQ(seen.radiance.norm(), 0);
  EXPECT_NEAR(seen.density, 1 / (4 * kPi), 0.1 / (4 * kPi));  // sines between the centres of 4 rows
}

}  // namespace
}  // namespace faceprobe::render
