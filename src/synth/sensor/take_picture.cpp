#include "faceprobe/core/color.h"
#include "faceprobe/synth/sensor.h"
#include "synth/light/blur.h"
#include "synth/sensor/jpeg.h"
#include "synth/sensor/noise.h"
#include "synth/sensor/tone_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

// Light that one pixel can spread: a sun in the picture blooms as far as the lens blur reaches, and sums stay finite.
constexpr float kMostLight = 256.0F;
// A blur of less variance than .0025 moves no code value.
constexpr float kLeastBlur = 0.05F;

Planes with_vignetting(const Image& radiance, float loss) {
  Planes light(radiance.width(), radiance.height(), 3);
  const float middle_x = 0.5F * static_cast<float>(radiance.width());
  const float middle_y = 0.5F * static_cast<float>(radiance.height());
  const float scale = loss / (middle_x * middle_x + middle_y * middle_y);
  for (int y = 0; y < radiance.height(); ++y) {
    const float dy = static_cast<float>(y) + 0.5F - middle_y;
    const float* in = radiance.row(y).data();
    const auto start = static_cast<std::size_t>(y) * static_cast<std::size_t>(radiance.width());
    float* red = light.plane(0) + start;
    float* green = light.plane(1) + start;
    float* blue = light.plane(2) + start;
    for (int x = 0; x < radiance.width(); ++x) {
      const float dx = static_cast<float>(x) + 0.5F - middle_x;
      const float kept = 1.0F - scale * (dx * dx + dy * dy);
      const auto seen = [kept](float value) { return value > 0.0F ? kept * std::min(value, kMostLight) : 0.0F; };
      red[x] = seen(in[3 * x]);
      green[x] = seen(in[3 * x + 1]);
      blue[x] = seen(in[3 * x + 2]);
    }
  }
  return light;
}

// Variance = read^2 + shot^2 * light: electrons are counted, so theirs grows with the light (Foi et al. 2008).
void add_noise(Planes& light, const SensorSettings& settings, std::uint64_t key) {
  const float read = settings.read_noise * settings.read_noise;
  const float shot = settings.shot_noise * settings.shot_noise;
  std::vector<float> normals(light.values.size());
  fill_normals(normals.data(), normals.size(), key);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    light.values[i] += std::sqrt(read + shot * light.values[i]) * normals[i];
  }
}

ByteImage clip_flags(const Planes& light) {
  ByteImage clip(light.width, light.height, 1);
  const float* red = light.plane(0);
  const float* green = light.plane(1);
  const float* blue = light.plane(2);
  for (std::size_t i = 0; i < light.size; ++i) {
    const int bits = (red[i] >= 1.0F ? 1 : 0) | (green[i] >= 1.0F ? 2 : 0) | (blue[i] >= 1.0F ? 4 : 0);
    clip.data()[i] = static_cast<std::uint8_t>(bits);
  }
  return clip;
}

// What the sensor holds, as one channel: Rec.709's weights on what was recorded, so clipped channels count as white.
Planes without_colour(const Planes& light) {
  Planes grey(light.width, light.height, 1);
  const auto recorded = [](float value) { return std::min(1.0F, std::max(0.0F, value)); };
  for (std::size_t i = 0; i < light.size; ++i) {
    grey.values[i] = luminance(recorded(light.plane(0)[i]), recorded(light.plane(1)[i]), recorded(light.plane(2)[i]));
  }
  return grey;
}

// Unsharp mask on code values, as cameras do: what a small blur takes away is added again.
void sharpen(Planes& codes, float amount) {
  const std::vector<float> kernel = {0.5F, 0.25F};
  std::vector<float> soft(codes.size);
  for (int c = 0; c < codes.channels; ++c) {
    float* sharp = codes.plane(c);
    std::copy_n(sharp, codes.size, soft.data());
    blur_plane(soft.data(), codes.width, codes.height, kernel);
    for (std::size_t i = 0; i < codes.size; ++i) sharp[i] += amount * (sharp[i] - soft[i]);
  }
}

ByteImage to_bytes(const Planes& codes) {
  ByteImage photo(codes.width, codes.height, 3);
  const float* red = codes.plane(0);
  const float* green = codes.plane(codes.channels == 3 ? 1 : 0);
  const float* blue = codes.plane(codes.channels == 3 ? 2 : 0);
  for (std::size_t i = 0; i < codes.size; ++i) {
    photo.data()[3 * i] = static_cast<std::uint8_t>(static_cast<int>(red[i]));
    photo.data()[3 * i + 1] = static_cast<std::uint8_t>(static_cast<int>(green[i]));
    photo.data()[3 * i + 2] = static_cast<std::uint8_t>(static_cast<int>(blue[i]));
  }
  return photo;
}

}  // namespace

SensorPicture take_picture(const Image& radiance, const SensorSettings& settings, Random& random) {
  const std::string wrong = settings.validate();
  if (!wrong.empty()) throw std::invalid_argument(wrong);
  if (radiance.channels() != 3) throw std::invalid_argument("A camera takes a picture of three channels.");
  // Drawn whether it is used or not, so that what follows does not depend on the settings.
  const std::uint64_t key = (static_cast<std::uint64_t>(random.bits()) << 32U) | random.bits();
  if (radiance.empty())
    return {ByteImage(radiance.width(), radiance.height(), 3), ByteImage(radiance.width(), radiance.height(), 1)};

  Planes light = with_vignetting(radiance, settings.vignetting);
  if (settings.blur_px >= kLeastBlur) {
    const std::vector<float> kernel = gaussian_kernel(settings.blur_px);
    for (int c = 0; c < 3; ++c) blur_plane(light.plane(c), light.width, light.height, kernel);
  }
  if (settings.read_noise > 0 || settings.shot_noise > 0) add_noise(light, settings, key);
  ByteImage clip = clip_flags(light);

  Planes codes = settings.grey ? without_colour(light) : std::move(light);
  ToneTable(settings.curve_shoulder, settings.curve_contrast).encode(codes.values.data(), codes.values.size());
  if (settings.sharpening > 0) sharpen(codes, settings.sharpening);
  for (float& code : codes.values) code = std::nearbyint(std::min(255.0F, std::max(0.0F, code)));
  if (settings.jpeg_quality > 0) jpeg_planes(codes, settings.jpeg_quality, settings.chroma_half);
  return {to_bytes(codes), std::move(clip)};
}

}  // namespace faceprobe::synth
