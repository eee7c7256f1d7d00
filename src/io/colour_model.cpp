#include "io/colour_model.h"

#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::io {
namespace {

template <class Code>
float unit_value(Code code) {
  if constexpr (sizeof(Code) == sizeof(float)) {
    return code;
  } else {
    return static_cast<float>(code) / static_cast<float>(level_count<Code>() - 1);
  }
}

// Negative and NaN become 0.
float not_negative(float value) { return value > 0 ? value : 0.0F; }

void apply_matrix(const Eigen::Matrix3f& m, std::size_t n, float* rgb) {
  for (std::size_t i = 0; i < n; ++i, rgb += 3) {
    const float r = rgb[0];
    const float g = rgb[1];
    const float b = rgb[2];
    for (int k = 0; k < 3; ++k) rgb[k] = not_negative(m(k, 0) * r + m(k, 1) * g + m(k, 2) * b);
  }
}

}  // namespace

template <class Code>
void ColourModel::to_linear(const Code* codes, int stride, std::size_t n, float* rgb) const {
  if (transform) {
    std::vector<float> unit(n * static_cast<std::size_t>(channels));
    for (std::size_t i = 0, k = 0; i < n; ++i, codes += stride) {
      for (int c = 0; c < channels; ++c) unit[k++] = unit_value(codes[c]);
    }
    transform(unit.data(), rgb, n);
    std::transform(rgb, rgb + 3 * n, rgb, not_negative);
    return;
  }
  if constexpr (level_count<Code>() == 0) {
    for (std::size_t i = 0; i < n; ++i, codes += stride) {
      for (int c = 0; c < 3; ++c) rgb[3 * i + static_cast<std::size_t>(c)] = codes[channels == 3 ? c : 0];
    }
  } else {
    const float* r = curve[0].data();
    if (channels == 1) {
      for (std::size_t i = 0; i < n; ++i, codes += stride) rgb[3 * i] = rgb[3 * i + 1] = rgb[3 * i + 2] = r[codes[0]];
      return;
    }
    const float* g = curve[1].empty() ? r : curve[1].data();
    const float* b = curve[2].empty() ? r : curve[2].data();
    for (std::size_t i = 0; i < n; ++i, codes += stride) {
      rgb[3 * i] = r[codes[0]];
      rgb[3 * i + 1] = g[codes[1]];
      rgb[3 * i + 2] = b[codes[2]];
    }
  }
  if (matrix && channels == 3) apply_matrix(*matrix, n, rgb);
}

template void ColourModel::to_linear(const std::uint8_t*, int, std::size_t, float*) const;
template void ColourModel::to_linear(const std::uint16_t*, int, std::size_t, float*) const;
template void ColourModel::to_linear(const float*, int, std::size_t, float*) const;

std::vector<float> sample_curve(std::size_t levels, const std::function<double(double)>& curve) {
  std::vector<float> table(levels);
  for (std::size_t i = 0; i < levels; ++i) {
    table[i] = static_cast<float>(curve(static_cast<double>(i) / static_cast<double>(levels - 1)));
  }
  return table;
}

ColourModel srgb_model(int channels, std::size_t levels) {
  ColourModel model;
  model.name = "sRGB (assumed)";
  model.channels = channels;
  model.curve[0] = sample_curve(levels, [](double code) { return linear_from_srgb(static_cast<float>(code)); });
  return model;
}

ColourModel gamma_model(int channels, std::size_t levels, double gamma) {
  ColourModel model;
  model.name = "gamma " + std::to_string(gamma).substr(0, 4);
  model.channels = channels;
  model.curve[0] = sample_curve(levels, [gamma](double code) { return std::pow(code, gamma); });
  return model;
}

ColourModel linear_model(int channels, std::size_t levels) {
  ColourModel model = gamma_model(channels, levels, 1.0);
  model.name = "linear";
  return model;
}

}  // namespace faceprobe::io
