// The grid against the definition of the joint bilateral filter.
#include "highlight/bilateral_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace faceprobe::highlight {
namespace {

constexpr BilateralSigmas kSigmas = {10, 0.04F};

Image direct_filter(const Image& guide, const Image& values) {
  Image out(guide.width(), guide.height(), 1);
  for (int y = 0; y < guide.height(); ++y) {
    for (int x = 0; x < guide.width(); ++x) {
      if (guide(x, y) < 0) continue;
      double sum = 0;
      double weights = 0;
      for (int v = 0; v < guide.height(); ++v) {
        for (int u = 0; u < guide.width(); ++u) {
          if (guide(u, v) < 0) continue;
          const double space = std::hypot(u - x, v - y) / static_cast<double>(kSigmas.spatial);
          const double range = (static_cast<double>(guide(u, v)) - guide(x, y)) / static_cast<double>(kSigmas.range);
          const double weight = std::exp(-0.5 * (space * space + range * range));
          sum += weight * values(u, v);
          weights += weight;
        }
      }
      out(x, y) = static_cast<float>(sum / weights);
    }
  }
  return out;
}

struct Field {
  Image guide{48, 40, 1};
  Image values{48, 40, 1};
};

// Two surfaces that differ in the guide, with values that vary in each, and a hole.
Field make_field() {
  Field field;
  std::mt19937 generator(4);
  const auto uniform = [&] { return static_cast<float>(generator() >> 8) / static_cast<float>(1 << 24); };
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      const bool left = x + y / 2 < 30;
      field.guide(x, y) = (left ? 0.6F : 0.75F) + 0.02F * uniform();
      field.values(x, y) = (left ? 0.35F : 0.6F) + 0.003F * static_cast<float>(y) + 0.02F * uniform();
      if (x > 10 && x < 20 && y > 10 && y < 25) field.guide(x, y) = -1;
    }
  }
  return field;
}

TEST(BilateralGrid, AgreesWithTheDirectSum) {
  const Field field = make_field();
  const Image fast = BilateralGrid(field.guide, kSigmas, 2).filter(field.values);
  const Image direct = direct_filter(field.guide, field.values);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      // Values span .4: cells of a quarter sigma and a window cut at three keep the error below one percent of that.
      ASSERT_NEAR(fast(x, y), direct(x, y), 0.004F) << x << ' ' << y;
    }
  }
}

TEST(BilateralGrid, ConstantStaysConstantAroundAHole) {
  const Field field = make_field();
  const Image fast = BilateralGrid(field.guide, kSigmas, 2).filter(Image(48, 40, 1, 0.4F));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) ASSERT_NEAR(fast(x, y), field.guide(x, y) < 0 ? 0.0F : 0.4F, 1e-5F);  // float sums
  }
}

TEST(BilateralGrid, SurfacesFarApartInTheGuideDoNotMix) {
  Field field = make_field();
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 48; ++x) {
      field.guide(x, y) = x < 24 ? 0.5F : 1.0F;  // twelve sigma
      field.values(x, y) = x < 24 ? 0.0F : 1.0F;
    }
  }
  EXPECT_EQ(BilateralGrid(field.guide, kSigmas, 2).filter(field.values), field.values);
}

}  // namespace
}  // namespace faceprobe::highlight
