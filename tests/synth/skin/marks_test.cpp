#include "synth/skin/marks.h"

#include "faceprobe/core/color.h"
#include "synth/skin/skin_fixture.h"

#include <gtest/gtest.h>
#include <functional>

namespace faceprobe::synth {
namespace {

// Albedo of plain skin at one place, before and after a change of the settings.
struct Change {
  Eigen::Vector3f before, after;
  float darker() const { return luminance(before.data()) / luminance(after.data()); }
};

Change change_at(const Eigen::Vector3f& position, Region region, const std::function<void(SkinSettings&)>& set) {
  SkinSettings settings;
  settings.target_tone = skin_tone(0.02F, 0.03F);
  SkinPoints points;
  points.rest_position = position.transpose();
  points.region = {region};
  points.footprint_m = Eigen::VectorXf::Constant(1, 0.002F);  // so that single hairs average out
  const Eigen::Vector3f before = skin_albedo(nullptr, settings, points).row(0).transpose();
  set(settings);
  return {before, skin_albedo(nullptr, settings, points).row(0).transpose()};
}

const Eigen::Vector3f kCheek(0.04F, -0.034F, 0.0F);
const Eigen::Vector3f kChin(0.0F, -0.098F, 0.02F);
const Eigen::Vector3f kLip(0.005F, -0.072F, 0.02F);
const Eigen::Vector3f kLid(0.032F, 0.006F, 0.0F);

TEST(SkinMarks, LieWhereTheyBelong) {
  const auto stubble = [](SkinSettings& s) { s.stubble = 1.0F; };
  EXPECT_GT(change_at(kChin, Region::kChin, stubble).darker(), 1.2F);
  EXPECT_EQ(change_at(kCheek, Region::kCheeks, stubble).darker(), 1.0F);  // above the beard's edge
  EXPECT_EQ(change_at(kLip, Region::kLips, stubble).darker(), 1.0F);
  const auto shadow = [](SkinSettings& s) { s.eye_shadow = 1.0F; };
  EXPECT_GT(change_at(kLid, Region::kEyelids, shadow).darker(), 1.5F);
  EXPECT_EQ(change_at(kChin, Region::kChin, shadow).darker(), 1.0F);
  const auto brow = [](SkinSettings& s) { s.brow = 1.0F; };
  EXPECT_GT(change_at({0.035F, 0.025F, 0.01F}, Region::kBrows, brow).darker(), 1.5F);
  EXPECT_EQ(change_at({0.035F, 0.025F, 0.01F}, Region::kForehead, brow).darker(), 1.0F);
}

TEST(SkinMarks, RednessAndBlushTakeGreenRatherThanRed) {
  const auto red_of = [](const Change& c) { return (c.after[0] / c.after[1]) / (c.before[0] / c.before[1]); };
  EXPECT_GT(red_of(change_at(kCheek, Region::kCheeks, [](SkinSettings& s) { s.redness = 1.0F; })), 1.05F);
  EXPECT_GT(red_of(change_at(kCheek, Region::kCheeks, [](SkinSettings& s) { s.blush = 1.0F; })), 1.05F);
}

TEST(SkinMarks, LipstickIsItsColour) {
  const Change change = change_at(kLip, Region::kLips, [](SkinSettings& s) { s.lip_tint = 1.0F; });
  EXPECT_NEAR(change.after[0], 0.4F, 0.12F);  // 85 % cover, and darker or lighter as the lip under it
  EXPECT_LT(change.after[1], 0.3F * change.after[0]);
  EXPECT_EQ(change_at(kCheek, Region::kCheeks, [](SkinSettings& s) { s.lip_tint = 1.0F; }).darker(), 1.0F);
}

TEST(SkinMarks, SoftSharesFadeMakeUp) {
  SkinSettings settings;
  settings.target_tone = skin_tone(0.02F, 0.03F);
  settings.lip_tint = 1.0F;
  SkinPoints points;
  points.rest_position = Eigen::MatrixX3f(kLip.transpose().replicate(3, 1));
  points.region.assign(3, Region::kLips);
  points.soft = Eigen::MatrixX4f::Zero(3, 4);
  points.soft.row(0) = soft_regions({Region::kLips, Region::kLips, Region::kLips}, {0.2F, 0.3F, 0.5F});
  points.soft.row(1) = soft_regions({Region::kLips, Region::kChin, Region::kLips}, {0.2F, 0.5F, 0.3F});
  EXPECT_TRUE(points.soft.row(1).isApprox(Eigen::RowVector4f(0.5F, 0, 0, 0.5F)));
  const Eigen::MatrixX3f albedo = skin_albedo(nullptr, settings, points);
  EXPECT_LT(albedo(0, 1), albedo(1, 1));
  EXPECT_LT(albedo(1, 1), albedo(2, 1));
}

TEST(SkinMarks, FrecklesGetFainterAndKeepTheirSumInWidePixels) {
  SkinSettings settings;
  settings.target_tone = skin_tone(0.015F, 0.03F);
  settings.freckles = 1.0F;
  settings.seed = 5;
  const Marks marks(settings);
  Random random({4});
  const auto deviations = [&](float footprint_m) {
    double sum = 0;
    float largest = 0;
    for (int i = 0; i < 40000; ++i) {
      SkinPlace place;
      place.position = {static_cast<float>(random.between(0.01, 0.04)),
                        static_cast<float>(random.between(-0.04, -0.015)), 0.01F};
      place.footprint_m = footprint_m;
      const float melanin = marks.pigment(place).melanin;
      sum += static_cast<double>(melanin);
      largest = std::max(largest, melanin);
    }
    return std::pair(sum / 40000, largest);
  };
  const auto [fine_mean, fine_peak] = deviations(0.0F);
  const auto [wide_mean, wide_peak] = deviations(0.0015F);
  EXPECT_GT(fine_peak, 0.3F);
  EXPECT_LT(wide_peak, 0.8F * fine_peak);
  // Spots are widened within their cells and two layers are joined by their maximum, so the sum is kept only roughly.
  EXPECT_NEAR(wide_mean / fine_mean, 1.0, 0.35);
}

}  // namespace
}  // namespace faceprobe::synth
