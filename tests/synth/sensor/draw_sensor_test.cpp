#include "faceprobe/synth/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace faceprobe::synth {
namespace {

constexpr int kDraws = 4000;

std::vector<SensorSettings> draw_many(const SensorRange& range) {
  std::vector<SensorSettings> settings;
  for (int i = 0; i < kDraws; ++i) {
    Random random({7, static_cast<std::uint64_t>(i)});
    settings.push_back(draw_sensor(range, random));
  }
  return settings;
}

template <class Test>
double share(const std::vector<SensorSettings>& settings, const Test& test) {
  return static_cast<double>(std::count_if(settings.begin(), settings.end(), test)) / kDraws;
}

TEST(DrawSensor, StaysWithinTheRangeAndValidates) {
  const SensorRange range;
  for (const SensorSettings& s : draw_many(range)) {
    EXPECT_EQ(s.validate(), "");
    EXPECT_LE(s.blur_px, range.max_blur_px);
    EXPECT_LE(s.shot_noise, range.max_noise);
    EXPECT_LE(s.read_noise, 0.5F * range.max_noise);
    EXPECT_GE(s.jpeg_quality, range.min_jpeg_quality);
  }
}

TEST(DrawSensor, SharesAreTheOnesOfTheRange) {
  const std::vector<SensorSettings> settings = draw_many({.grey_share = 0.1F, .plain_share = 0.3F});
  const auto plain = [](const SensorSettings& s) {
    return s.shot_noise == 0 && s.sharpening == 0 && s.jpeg_quality == 95;
  };
  // Four standard errors, sqrt(p (1 - p) / 4000): .019 and .029.
  EXPECT_NEAR(share(settings, [](const SensorSettings& s) { return s.grey; }), 0.1, 0.019);
  EXPECT_NEAR(share(settings, plain), 0.3, 0.029);
}

TEST(DrawSensor, MostAreMildAndSomeAreStrong) {
  const SensorRange range{.plain_share = 0};
  const std::vector<SensorSettings> settings = draw_many(range);
  const auto strong_noise = [&](const SensorSettings& s) { return s.shot_noise > 0.5F * range.max_noise; };
  EXPECT_GT(share(settings, strong_noise), 0.1);
  EXPECT_LT(share(settings, strong_noise), 0.4);
  const auto low_quality = [](const SensorSettings& s) { return s.jpeg_quality < 75; };
  EXPECT_GT(share(settings, low_quality), 0.1);
  EXPECT_LT(share(settings, low_quality), 0.5);
}

TEST(DrawSensor, SameKeySameCamera) {
  Random a({1, 2});
  Random b({1, 2});
  const SensorSettings x = draw_sensor({}, a);
  const SensorSettings y = draw_sensor({}, b);
  EXPECT_EQ(x.blur_px, y.blur_px);
  EXPECT_EQ(x.jpeg_quality, y.jpeg_quality);
  EXPECT_EQ(a.bits(), b.bits());
}

}  // namespace
}  // namespace faceprobe::synth
