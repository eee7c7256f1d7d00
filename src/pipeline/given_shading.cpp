#include "pipeline/given_shading.h"

#include "faceprobe/core/color.h"
#include "faceprobe/lighting/albedo.h"
#include "pipeline/face_reader.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::pipeline {

Image given_shading(const ShadingSplit& split, const Image& diffuse, const ByteImage& skin, const ByteImage& clipped,
                    int threads) {
  const face::Crop copy = small_crop({.width = diffuse.width(), .height = diffuse.height()});
  const Image small = face::crop_picture(diffuse, copy, threads);
  const Image answer = split(small);
  if (!answer.same_size(small) || answer.channels() != 3) {
    throw std::invalid_argument("shading_split: the shading must have 3 channels and the size of the diffuse layer, " +
                                std::to_string(small.width()) + " x " + std::to_string(small.height()) + ", found " +
                                std::to_string(answer.width()) + " x " + std::to_string(answer.height()) + " of " +
                                std::to_string(answer.channels()));
  }
  Image shading = face::crop_picture(
      answer, {.x_px = 0, .y_px = 0, .scale = 1 / copy.scale, .width = diffuse.width(), .height = diffuse.height()},
      threads);

  double seen = 0;
  double light = 0;
  double pixels = 0;
  for (std::size_t i = 0; i < skin.values().size(); ++i) {
    if (skin.data()[i] == 0 || clipped.data()[i] != 0) continue;
    seen += luminance(diffuse.data() + 3 * i);
    light += luminance(shading.data() + 3 * i);
    pixels += 1;
  }
  constexpr double kLeastShare = 0.01;
  const double gain = seen > 0 && light > 0 ? seen / (lighting::kSkinLuminance * light) : 1;
  const auto least = static_cast<float>(kLeastShare * gain * light / std::max(1.0, pixels));
  for (float& value : shading.values()) value = std::max(least, static_cast<float>(gain) * value);
  return shading;
}

}  // namespace faceprobe::pipeline
