#pragma once
// How light or dark a skin is, as dermatology grades it: by the individual typology angle (ITA) of its colour. For grouping
// results, so that a mean over everybody does not hide who is served worse.
//
// It grades albedo, not the look of a photo: shading, highlights and the colour of the light have to be out of it, and 1
// has to be a perfect white. Brightness that is off by a factor moves people from class to class. Not a statement about
// persons.
//
//   const double ita = eval::ita_deg(mean_skin_albedo);         // linear Rec.709, each channel in [0, 1]
//   groups["skin"] = eval::skin_tone_name(eval::skin_tone(ita));  // "intermediate"

#include <Eigen/Core>
#include <array>
#include <string_view>

namespace faceprobe::eval {

// CIE 1976 L*, a*, b* of linear Rec.709, the white point of both being D65 (IEC 61966-2-1; CIE 15).
Eigen::Vector3d lab_from_linear(const Eigen::Vector3d& rgb);

// atan((L* - 50) / b*) in degrees (Chardon, Cretois & Hourseau 1991, "Skin colour typology and suntanning pathways", Int. J.
// Cosmetic Science 13). Where b* <= 0, which no skin has, the angle goes on past 90: blue as light as skin stays light.
double ita_deg(const Eigen::Vector3d& linear_albedo);

// Limits of Chardon et al. 1991 as used by Del Bino & Bernerd 2013 ("Variations in skin colour and the biological
// consequences of ultraviolet radiation exposure", British J. Dermatology 169 s3); a limit belongs to the class below it.
enum class SkinTone {
  kVeryLight,     // over 55 degrees
  kLight,         // over 41
  kIntermediate,  // over 28
  kTan,           // over 10
  kBrown,         // over -30
  kDark,
};
inline constexpr std::array<SkinTone, 6> kSkinTones = {SkinTone::kVeryLight, SkinTone::kLight, SkinTone::kIntermediate,
                                                       SkinTone::kTan,       SkinTone::kBrown, SkinTone::kDark};
// Throws std::invalid_argument for NaN.
SkinTone skin_tone(double ita_deg);
std::string_view skin_tone_name(SkinTone tone);  // "very light", "light", "intermediate", "tan", "brown", "dark"

}  // namespace faceprobe::eval
