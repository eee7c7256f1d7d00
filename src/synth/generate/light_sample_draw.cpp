#include "synth/generate/light_sample_draw.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Cameras expose a middle skin to about a quarter of white, and let a dark one come out darker, by half as many stops.
constexpr float kUsualFace = 0.26F;
constexpr float kUsualTone = 0.30F;
constexpr float kFaceMin = 0.03F;
constexpr float kFaceMax = 0.75F;

}  // namespace

SampleDraw draw_sample(const Assets& assets, const Recipe& recipe, Random& random, int index) {
  SampleDraw draw;
  draw.map = random.below(static_cast<int>(assets.maps.size()));
  draw.map_yaw = static_cast<float>(random.between(-kPi, kPi));
  if (recipe.multi_face) {
    const auto level = static_cast<float>(random.log_between(0.03, 0.5));
    if (recipe.lamps != 0) draw.map_level = level;  // beside no lamp the map is not dimmed
  }
  draw.skin = index % recipe.skins_per_person;
  if (recipe.mode == Mode::kPaper) {
    draw.sensor = {.blur_px = 0, .vignetting = 0, .read_noise = 0, .shot_noise = 0, .sharpening = 0, .jpeg_quality = 0};
    return draw;
  }
  draw_camera(random, recipe.size_px, draw);
  return draw;
}

void draw_camera(Random& random, int size_px, SampleDraw& draw) {
  draw.white_balance = static_cast<float>(random.between(0.35, 1.0));
  for (int c = 0; c < 3; ++c) draw.cast(c) = static_cast<float>(std::exp(random.normal(0, 0.05)));
  draw.cast /= draw.cast.dot(kLuminanceWeights);
  draw.exposure = static_cast<float>(std::exp(random.normal(0, 0.33)));
  draw.background_blur_px = static_cast<float>(random.between(0.002, 0.02) * size_px);
  draw.sensor = draw_sensor({}, random);
}

Eigen::Vector3f exposure_gain(const SampleDraw& draw, const Eigen::Vector3f& face, const Eigen::Vector3f& light,
                              const Eigen::Vector3f& tone) {
  Eigen::Vector3f gain = draw.cast;
  const float light_luminance = light.dot(kLuminanceWeights);
  if (light_luminance > 0) {
    for (int c = 0; c < 3; ++c) gain(c) *= std::pow(std::max(0.02F, light(c) / light_luminance), -draw.white_balance);
  }
  const float seen = gain.cwiseProduct(face).dot(kLuminanceWeights);
  if (!(seen > 0)) return Eigen::Vector3f::Ones();
  const float wanted = kUsualFace * std::sqrt(tone.dot(kLuminanceWeights) / kUsualTone) * draw.exposure;
  return gain * (std::clamp(wanted, kFaceMin, kFaceMax) / seen);
}

}  // namespace faceprobe::synth
