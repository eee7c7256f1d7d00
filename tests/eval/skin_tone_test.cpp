#include "faceprobe/eval/skin_tone.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace faceprobe::eval {
namespace {

// CIE 15 backwards, with the inverse matrix as published (B. Lindbloom, sRGB, D65).
Eigen::Vector3d linear_from_lab(double lightness, double a, double b) {
  const double fy = (lightness + 16) / 116;
  const auto curve = [](double f) { return f > 6.0 / 29 ? f * f * f : 3 * 36.0 / 841 * (f - 4.0 / 29); };
  const Eigen::Vector3d xyz(0.95047 * curve(fy + a / 500), curve(fy), 1.08883 * curve(fy - b / 200));
  Eigen::Matrix3d m;
  m << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434, -0.2040259, 1.0572252;
  return m * xyz;
}

TEST(Lab, OfKnownColours) {
  const auto expect_lab = [](const Eigen::Vector3d& rgb, const Eigen::Vector3d& lab, double tolerance) {
    EXPECT_LT((lab_from_linear(rgb) - lab).cwiseAbs().maxCoeff(), tolerance) << lab_from_linear(rgb).transpose();
  };
  expect_lab({1, 1, 1}, {100, 0, 0}, 1e-12);
  expect_lab({0, 0, 0}, {0, 0, 0}, 1e-12);
  // Lab of the sRGB primaries as published, two digits.
  expect_lab({1, 0, 0}, {53.24, 80.09, 67.20}, 0.01);
  expect_lab({0, 1, 0}, {87.73, -86.18, 83.18}, 0.01);
  expect_lab({0, 0, 1}, {32.30, 79.19, -107.86}, 0.01);
}

TEST(Ita, OfKnownLab) {
  // Matrix and inverse are published with seven digits.
  EXPECT_NEAR(ita_deg(linear_from_lab(70, 12, 20)), 45, 1e-3);
  EXPECT_NEAR(ita_deg(linear_from_lab(50, 12, 18)), 0, 1e-3);
  EXPECT_NEAR(ita_deg(linear_from_lab(35, 10, 15)), -45, 1e-3);
  EXPECT_NEAR(ita_deg(linear_from_lab(60, 11, 10 * std::sqrt(3.0))), 30, 1e-3);
}

TEST(Ita, OfGreys) {
  EXPECT_NEAR(ita_deg({1, 1, 1}), 90, 1e-9);
  EXPECT_NEAR(ita_deg({0, 0, 0}), -90, 1e-9);
  EXPECT_NEAR(ita_deg({0.3, 0.3, 0.3}), 90, 1e-9);  // lighter than L* = 50
}

TEST(Ita, GoesOnPastBlue) {
  EXPECT_GT(ita_deg(linear_from_lab(80, 0, -10)), 90);
  EXPECT_EQ(skin_tone(ita_deg(linear_from_lab(80, 0, -10))), SkinTone::kVeryLight);
  EXPECT_EQ(skin_tone(ita_deg(linear_from_lab(20, 0, -10))), SkinTone::kDark);
}

TEST(SkinTone, LimitsBelongToTheClassBelow) {
  const std::array<double, 5> limits = {55, 41, 28, 10, -30};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_EQ(skin_tone(std::nextafter(limits[i], 100.0)), kSkinTones[i]);
    EXPECT_EQ(skin_tone(limits[i]), kSkinTones[i + 1]);
  }
  EXPECT_THROW(skin_tone(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Ita, OfTheSkinPatchesOfTheColorChecker) {
  const auto ita = [](float r, float g, float b) {
    return ita_deg(
        Eigen::Vector3f(linear_from_srgb(r / 255), linear_from_srgb(g / 255), linear_from_srgb(b / 255)).cast<double>());
  };
  // From the chart's published Lab, 65.71 18.13 17.81 and 37.99 13.56 14.06 (D50). Its published sRGB is rounded and
  // adapted to D65: two degrees.
  EXPECT_NEAR(ita(194, 150, 130), degrees(std::atan2(15.71, 17.81)), 2);
  EXPECT_NEAR(ita(115, 82, 68), degrees(std::atan2(-12.01, 14.06)), 2);
}

TEST(SkinTone, EachHasAName) {
  std::string all;
  for (const SkinTone tone : kSkinTones) all += std::string(skin_tone_name(tone)) + ' ';
  EXPECT_EQ(all, "very light light intermediate tan brown dark ");
}

}  // namespace
}  // namespace faceprobe::eval
