#include "faceprobe/eval/skin_tone.h"

#include "faceprobe/core/angles.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

Eigen::Matrix3d xyz_from_rec709() {
  Eigen::Matrix3d m;
  m << 0.4124564, 0.3575761, 0.1804375,  //
      0.2126729, 0.7151522, 0.0721750,   //
      0.0193339, 0.1191920, 0.9503041;
  return m;
}

// CIE 15: the cube root, with a line near black.
double lightness_curve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

Eigen::Vector3d lab_from_linear(const Eigen::Vector3d& rgb) {
  const Eigen::Matrix3d to_xyz = xyz_from_rec709();
  const Eigen::Vector3d white = to_xyz.rowwise().sum();  // of this matrix, so that its greys are grey to the last digit
  const Eigen::Vector3d f = (to_xyz * rgb).cwiseQuotient(white).unaryExpr(&lightness_curve);
  return {116 * f.y() - 16, 500 * (f.x() - f.y()), 200 * (f.y() - f.z())};
}

double ita_deg(const Eigen::Vector3d& linear_albedo) {
  const Eigen::Vector3d lab = lab_from_linear(linear_albedo);
  return degrees(std::atan2(lab.x() - 50, lab.z()));
}

SkinTone skin_tone(double ita_deg) {
  if (std::isnan(ita_deg)) throw std::invalid_argument("skin_tone: the angle is NaN");
  if (ita_deg > 55) return SkinTone::kVeryLight;
  if (ita_deg > 41) return SkinTone::kLight;
  if (ita_deg > 28) return SkinTone::kIntermediate;
  if (ita_deg > 10) return SkinTone::kTan;
  if (ita_deg > -30) return SkinTone::kBrown;
  return SkinTone::kDark;
}

std::string_view skin_tone_name(SkinTone tone) {
  switch (tone) {
    case SkinTone::kVeryLight: return "very light";
    case SkinTone::kLight: return "light";
    case SkinTone::kIntermediate: return "intermediate";
    case SkinTone::kTan: return "tan";
    case SkinTone::kBrown: return "brown";
    case SkinTone::kDark: return "dark";
  }
  throw std::invalid_argument("skin_tone_name: unknown tone");
}

}  // namespace faceprobe::eval
