#pragma once
// From light to the file a camera writes: lens blur, vignetting, exposure with clipping, noise, response curve, sharpening, JPEG.
// Everything is drawn from a Random, so the same key gives the same bytes.
//
//   const SensorSettings settings = draw_sensor({}, random);
//   const SensorPicture picture = take_picture(radiance, settings, random);

#include "faceprobe/core/image.h"
#include "faceprobe/core/random.h"

#include <string>

namespace faceprobe::synth {

struct SensorSettings {
  float blur_px = 0.5F;         // Gaussian's deviation
  float vignetting = 0.1F;      // light lost in the corners, 0 .. 1
  float read_noise = 0.002F;    // standard deviation at black; 1 = white
  float shot_noise = 0.01F;     // standard deviation at white; grows with the root of the light
  float curve_contrast = 0.0F;  // tone curve on top of sRGB's: -1 flat .. 1 strong S
  float curve_shoulder = 0.0F;  // 0 = hard clip at white, 1 = long roll-off of the highlights
  float sharpening = 0.2F;      // unsharp mask's amount
  int jpeg_quality = 90;        // 1 .. 100; 0 = none
  bool chroma_half = true;      // 4:2:0
  bool grey = false;            // a black and white photo

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// How a range of cameras differs; every figure a typical extreme.
struct SensorRange {
  float max_blur_px = 1.0F;
  float max_noise = 0.02F;  // of SensorSettings::shot_noise
  int min_jpeg_quality = 55;
  float grey_share = 0.02F;
  float plain_share = 0.2F;  // sRGB curve, no noise, quality 95: what a good camera's small picture looks like
};
// A camera out of that range; small blur and little noise are the most common.
SensorSettings draw_sensor(const SensorRange& range, Random& random);

struct SensorPicture {
  ByteImage photo;  // sRGB-encoded, three channels
  ByteImage clip;   // one channel: bit c set where channel c of the exposed picture was at or over white
};
// `radiance`: three channels, linear, 1 = white; negative values and NaN are black. Throws std::invalid_argument for settings that
// do not validate and another number of channels.
SensorPicture take_picture(const Image& radiance, const SensorSettings& settings, Random& random);

// What JPEG's quantisation does to a picture, without writing one: 8x8 DCT (ITU-T T.81), the tables of its Annex K scaled the way
// libjpeg does, chroma at half size when asked. One or three channels; quality 1 .. 100; else
// std::invalid_argument.
ByteImage jpeg_round_trip(const ByteImage& picture, int quality, bool chroma_half);

}  // namespace faceprobe::synth
