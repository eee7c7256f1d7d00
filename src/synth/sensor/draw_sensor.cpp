#include "faceprobe/synth/sensor.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

bool within(float value, float low, float high) { return value >= low && value <= high; }  // false for NaN

}  // namespace

std::string SensorSettings::validate() const {
  if (!within(blur_px, 0, 24)) return "The lens blur must be 0 to 24 pixels.";
  if (!within(vignetting, 0, 1)) return "The vignetting must be 0 to 1.";
  if (!within(read_noise, 0, 1) || !within(shot_noise, 0, 1)) return "The noise must be 0 to 1.";
  if (!within(curve_contrast, -1, 1)) return "The contrast of the curve must be -1 to 1.";
  if (!within(curve_shoulder, 0, 1)) return "The shoulder of the curve must be 0 to 1.";
  if (!within(sharpening, 0, 10)) return "The sharpening must be 0 to 10.";
  if (jpeg_quality < 0 || jpeg_quality > 100) return "The JPEG quality must be 1 to 100, or 0 for none.";
  return {};
}

SensorSettings draw_sensor(const SensorRange& range, Random& random) {
  SensorSettings settings;
  settings.grey = random.chance(range.grey_share);
  if (random.chance(range.plain_share)) {
    settings.blur_px = 0;
    settings.vignetting = 0;
    settings.read_noise = 0;
    settings.shot_noise = 0;
    settings.sharpening = 0;
    settings.jpeg_quality = 95;
    return settings;
  }
  // Powers of a uniform number: most photos come small from a larger one, so little blur and noise is left; some are crops of
  // a face far away, or were taken in the dark.
  const auto rarely_large = [&random](double power) { return static_cast<float>(std::pow(random.uniform(), power)); };
  settings.blur_px = range.max_blur_px * rarely_large(1.5);
  settings.vignetting = 0.3F * rarely_large(2.0);
  settings.shot_noise = range.max_noise * rarely_large(2.5);
  settings.read_noise = settings.shot_noise * static_cast<float>(random.between(0.1, 0.5));
  settings.curve_contrast = static_cast<float>(std::clamp(random.normal(0.15, 0.35), -1.0, 1.0));
  settings.curve_shoulder = rarely_large(1.5);
  settings.sharpening = 0.8F * rarely_large(1.5);
  // Files of 85 to 95 are the most common; the lower end is what messengers send.
  const auto best = static_cast<float>(std::max(98, range.min_jpeg_quality));
  const float lost = (best - static_cast<float>(range.min_jpeg_quality)) * rarely_large(1.7);
  settings.jpeg_quality = std::clamp(static_cast<int>(std::lround(best - lost)), 1, 100);
  settings.chroma_half = random.chance(0.8);
  return settings;
}

}  // namespace faceprobe::synth
