#pragma once
// Between linear Rec.709 light and the sRGB code values that files and screens carry (IEC 61966-2-1), and from HDR to a
// picture to look at. Not a colour-management system: photos with an ICC profile are converted in io/photo.h.
//
//   const ByteImage preview = encode_srgb(picture, exposure_for_quantile(picture, 0.9F, 0.6F));

#include "faceprobe/core/image.h"

#include <Eigen/Core>

namespace faceprobe {

// Code value in [0, 1] to linear light and back. Values outside [0, 1] follow the curve, mirrored below zero.
float linear_from_srgb(float encoded);
float srgb_from_linear(float linear);

// Relative luminance of linear Rec.709 (CIE Y weights of ITU-R BT.709).
inline float luminance(float r, float g, float b) { return 0.2126F * r + 0.7152F * g + 0.0722F * b; }
inline float luminance(const float* rgb) { return luminance(rgb[0], rgb[1], rgb[2]); }

// sRGB bytes of `linear * gain`, clipped at 1: the same size and channels. NaN becomes 0.
ByteImage encode_srgb(const Image& linear, float gain = 1.0F);
// Linear light of sRGB bytes; the channel count is kept.
Image decode_srgb(const ByteImage& encoded);

// Gain that puts the given quantile (0..1) of the luminance, or of the first channel where there are fewer than three, at the given linear
// level; 1 when the picture is empty or that quantile is not above 0.
float exposure_for_quantile(const Image& linear, float quantile, float level);

}  // namespace faceprobe
