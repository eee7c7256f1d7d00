#include "train/histogram_transfer.h"

#include "faceprobe/core/random.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace faceprobe::train {
namespace {

// Skin-like: log-normal about a level, as shading makes it.
Image skin(int width, int height, const std::vector<double>& level, std::uint64_t seed) {
  Random random({seed});
  Image picture(width, height, static_cast<int>(level.size()));
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    const double shading = std::exp(0.4 * random.normal());
    for (std::size_t c = 0; c < level.size(); ++c) {
      picture.data()[i * level.size() + c] = static_cast<float>(level[c] * shading * std::exp(0.05 * random.normal()));
    }
  }
  return picture;
}

double quantile(const Image& picture, int channel, double share) {
  std::vector<float> values;
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    values.push_back(
        picture.data()[i * static_cast<std::size_t>(picture.channels()) + static_cast<std::size_t>(channel)]);
  }
  std::sort(values.begin(), values.end());
  return static_cast<double>(values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))]);
}

TEST(HistogramTransfer, EqualHistogramsGiveThePictureBack) {
  const Image picture = skin(60, 50, {0.4, 0.25, 0.15}, 1);
  // The reference has the same values elsewhere.
  Image reference = picture;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x) {
      for (int c = 0; c < 3; ++c) reference(x, y, c) = picture(59 - x, 49 - y, c);
    }
  }
  const Image same = transfer_histogram(picture, {}, reference, {});
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    ASSERT_FLOAT_EQ(same.data()[i], picture.data()[i]);  // double inside, so only the last float's rounding
  }
}

TEST(HistogramTransfer, AChangeOfLightIsUndone) {
  const Image picture = skin(200, 200, {0.4, 0.25, 0.15}, 2);
  Image lit = picture;  // a warmer, dimmer light
  const float gain[3] = {0.9F, 0.7F, 0.4F};
  for (std::size_t i = 0; i < lit.values().size(); ++i) lit.data()[i] *= gain[i % 3];
  const Image back = transfer_histogram(lit, {}, picture, {});
  double worst = 0;
  for (std::size_t i = 0; i < back.values().size(); ++i) {
    worst = std::max(worst, static_cast<double>(std::abs(back.data()[i] / picture.data()[i] - 1)));
  }
  // One bin is 1/1024 of the root's range, which reaches about 3 times the median's root: .6 % of a median value, 2 %
  // of a dark one; each of the two distributions is wrong by up to a bin.
  EXPECT_LT(worst, 0.08);
}

TEST(HistogramTransfer, TheResultHasTheReferencesQuantiles) {
  const Image picture = skin(200, 150, {0.2, 0.2, 0.3}, 3);
  const Image reference = skin(100, 180, {0.5, 0.3, 0.2}, 4);
  const Image matched = transfer_histogram(picture, {}, reference, {});
  for (int c = 0; c < 3; ++c) {
    for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) {
      // A bin is up to 2 % of a value (above).
      EXPECT_NEAR(quantile(matched, c, share) / quantile(reference, c, share), 1, 0.02) << c << " at " << share;
    }
  }
}

TEST(HistogramTransfer, TheCurveIsStrictlyIncreasingAndFinite) {
  // Both histograms have wide gaps, spikes and no overlap: where curves become flat or jump.
  const std::vector<float> values = {-0.01F, 0, 0, 0, 0.1F, 0.1F, 0.1001F, 0.9F, 0.9F};
  const std::vector<float> reference = {2, 2, 2, 2, 2.0001F, 5, 8, 8};
  const HistogramCurve curve(values, reference, 256);
  double before = curve(-1);
  for (int i = 1; i <= 100'000; ++i) {
    const double x = -1 + 11.0 * i / 100'000;
    const double y = curve(x);
    ASSERT_TRUE(std::isfinite(y));
    ASSERT_GT(y, before) << "at " << x;
    before = y;
  }
  // Between one and four ninths of the picture's values lie below 0, which is in the reference's spike at 2: five
  // eighths of it.
  EXPECT_NEAR(curve(0), 2, 0.1);  // bins here are .012 wide on the root, .03 on the value, and each curve errs by one
}

TEST(HistogramTransfer, OneValueOnlyIsNotADivisionByZero) {
  const HistogramCurve same({0.5F}, {0.5F, 0.5F}, 256);
  EXPECT_NEAR(same(0.5), 0.5, 1e-12);
  const HistogramCurve moved({0.5F, 0.5F}, {0.25F}, 256);
  EXPECT_TRUE(std::isfinite(moved(0.5)));
  EXPECT_LT(moved(0.499999), moved(0.5));
}

TEST(HistogramTransfer, OnlyTheMaskCountsAndChanges) {
  Image picture = skin(40, 40, {0.3}, 5);
  const Image reference = skin(30, 30, {0.6}, 6);
  ByteImage mask(40, 40, 1);
  for (int y = 10; y < 30; ++y) {
    for (int x = 10; x < 30; ++x) mask(x, y) = 255;
  }
  const Image matched = transfer_histogram(picture, mask, reference, {});
  EXPECT_EQ(matched(3, 3), picture(3, 3));
  EXPECT_GT(matched(20, 20), 1.3F * picture(20, 20)) << "the reference is twice as bright";
  const float before = matched(20, 20);
  picture(3, 3) = std::numeric_limits<float>::quiet_NaN();
  picture(4, 4) = 1e6F;
  EXPECT_EQ(transfer_histogram(picture, mask, reference, {})(20, 20), before);
}

TEST(HistogramTransfer, RefusesWhatItCannotCount) {
  const Image picture = skin(8, 8, {0.3}, 7);
  const ByteImage none(8, 8, 1);
  EXPECT_THROW(transfer_histogram(picture, none, picture, {}), std::invalid_argument);
  EXPECT_THROW(transfer_histogram(picture, ByteImage(4, 8, 1, 1), picture, {}), std::invalid_argument);
  EXPECT_THROW(transfer_histogram(picture, {}, Image(8, 8, 3, 0.5F), {}), std::invalid_argument);
  EXPECT_THROW(transfer_histogram(picture, {}, picture, {}, {.bins = 16}), std::invalid_argument);
  Image broken = picture;
  broken(1, 1) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(transfer_histogram(broken, {}, picture, {}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train
