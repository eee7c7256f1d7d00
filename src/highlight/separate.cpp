#include "faceprobe/highlight/separate.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "highlight/scene.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace faceprobe::highlight {
namespace {

constexpr std::array<std::pair<Separator, std::string_view>, 3> kNames = {
    {{Separator::kTan, "tan"}, {Separator::kYang, "yang"}, {Separator::kShen, "shen"}}};

void check_sizes(const Image& linear, const ByteImage& mask) {
  if (linear.channels() != 3 && !linear.empty()) {
    throw std::invalid_argument("separate: the picture must have 3 channels, not " + std::to_string(linear.channels()));
  }
  if (!mask.empty() && (!mask.same_size(linear) || mask.channels() != 1)) {
    throw std::invalid_argument("separate: the mask must have one channel and the size of the picture");
  }
}

// The light scaled to mean 1, so that brightness, and every threshold on it, keeps its meaning.
std::array<float, 3> unit_light(const std::array<float, 3>& light) {
  const double mean = (static_cast<double>(light[0]) + light[1] + light[2]) / 3;
  std::array<float, 3> unit;
  for (std::size_t c = 0; c < 3; ++c) unit[c] = static_cast<float>(light[c] / mean);
  return unit;
}

Image white_highlight(const Scene& scene, Separator separator) {
  switch (separator) {
    case Separator::kTan: return tan_highlight(scene);
    case Separator::kYang: return yang_highlight(scene);
    case Separator::kShen: return shen_highlight(scene);
  }
  throw std::invalid_argument("separate: unknown separator");
}

// Gives the highlight the light's colour and caps it, so that no channel of the diffuse layer falls below zero.
Layers split(const Image& linear, const Image& amount, const std::array<float, 3>& light, int threads) {
  Layers layers{Image(linear.width(), linear.height(), 3), Image(linear.width(), linear.height(), 3)};
  parallel_for(linear.height(), threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < linear.width(); ++x) {
        const float* picture = linear.pixel(x, y);
        float* highlight = layers.highlight.pixel(x, y);
        float* diffuse = layers.diffuse.pixel(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
          // In this order std::min and std::max turn NaN and negative values of the picture into no highlight.
          highlight[c] = std::min(amount(x, y) * light[c], std::max(0.0F, picture[c]));
          diffuse[c] = picture[c] - highlight[c];
        }
      }
    }
  });
  return layers;
}

}  // namespace

std::string_view separator_name(Separator separator) {
  for (const auto& [value, name] : kNames) {
    if (value == separator) return name;
  }
  throw std::invalid_argument("separator_name: unknown separator");
}

Separator separator_from_name(std::string_view name) {
  std::string known;
  for (const auto& [value, known_name] : kNames) {
    if (known_name == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(known_name);
  }
  throw Error(ExitCode::kUsage, "There is no separator \"" + std::string(name) + "\"; choose one of: " + known + ".");
}

std::string SeparateOptions::validate() const {
  for (const float channel : light_colour) {
    if (!(channel > 0) || !std::isfinite(channel)) {
      std::ostringstream sentence;
      sentence << "light_colour is (" << light_colour[0] << ", " << light_colour[1] << ", " << light_colour[2]
               << "); each channel must be a finite number above 0.";
      return sentence.str();
    }
  }
  return {};
}

Layers separate(const Image& linear, const ByteImage& mask, const SeparateOptions& options) {
  check_sizes(linear, mask);
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  if (linear.empty()) return {Image(linear.width(), linear.height(), 3), Image(linear.width(), linear.height(), 3)};

  const std::array<float, 3> light = unit_light(options.light_colour);
  const Scene scene{linear, mask, {1 / light[0], 1 / light[1], 1 / light[2]}, options.threads};
  return split(linear, white_highlight(scene, options.separator), light, options.threads);
}

}  // namespace faceprobe::highlight
