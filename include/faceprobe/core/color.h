#pragma once
// Between linear Rec.709 light and the sRGB code values that files and screens carry (IEC 61966-2-1), and from HDR to a
// picture to look at. Not a colour-management system: photos with an ICC profile are converted in io/photo.h.
//
//   const ByteImage preview = encode_srgb(picture, exposure_for_quantile(picture, 0.9F, 0.6F));

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <concepts>

namespace faceprobe {

// Code value in [0, 1] to linear light and back. Values outside [0, 1] follow the curve, mirrored below zero.
float linear_from_srgb(float encoded);
float srgb_from_linear(float linear);

inline constexpr double kRedLuminance = 0.2126;    // the CIE Y weights of ITU-R BT.709, whose sum is 1
inline constexpr double kGreenLuminance = 0.7152;  // the same
inline constexpr double kBlueLuminance = 0.0722;   // the same
// The weights as a column, red first: luminance is its dot product with a linear colour.
template <class Scalar>
Eigen::Matrix<Scalar, 3, 1> luminance_weights() {
  return {static_cast<Scalar>(kRedLuminance), static_cast<Scalar>(kGreenLuminance), static_cast<Scalar>(kBlueLuminance)};
}
// The same in single precision; `radiance * kLuminanceWeights` are the luminances of N x 3 colours.
inline const Eigen::Vector3f kLuminanceWeights = luminance_weights<float>();

// Relative luminance of linear Rec.709, in the precision of the colour.
template <std::floating_point Scalar>
Scalar luminance(Scalar r, Scalar g, Scalar b) {
  return static_cast<Scalar>(kRedLuminance) * r + static_cast<Scalar>(kGreenLuminance) * g +
         static_cast<Scalar>(kBlueLuminance) * b;
}
template <std::floating_point Scalar>
Scalar luminance(const Scalar* rgb) {
  return luminance(rgb[0], rgb[1], rgb[2]);
}

// sRGB bytes of `linear * gain`, clipped at 1: the same size and channels. NaN becomes 0.
ByteImage encode_srgb(const Image& linear, float gain = 1.0F);
// Linear light of sRGB bytes; the channel count is kept.
Image decode_srgb(const ByteImage& encoded);

// Gain that puts the given quantile (0..1) of the luminance, or of the first channel where there are fewer than three, at the given linear
// level; 1 when the picture is empty or that quantile is not above 0.
float exposure_for_quantile(const Image& linear, float quantile, float level);

}  // namespace faceprobe
