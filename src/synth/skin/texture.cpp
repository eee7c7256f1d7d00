#include "synth/skin/texture.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/quantile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace faceprobe::synth {
namespace {

constexpr int kBroadPx = 64;  // on a side of the picture of broad deviations
constexpr float kBroadDeviation =
    0.04F;  // of the Gaussian that makes them broad, of the square's side: about a centimetre of skin
constexpr float kUnlikeSkin = 0.35F;  // deviation in log light beyond which brows, lips and beards count less and less

const std::array<float, 256>& log_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> logs{};
    for (std::size_t i = 0; i < logs.size(); ++i) {
      // Code 0 stands for anything up to half a step, so a quarter of the first step is its middle.
      logs[i] =
          std::log(i == 0 ? 0.25F * linear_from_srgb(1.0F / 255.0F) : linear_from_srgb(static_cast<float>(i) / 255.0F));
    }
    return logs;
  }();
  return table;
}

Image half_size(const Image& picture) {
  Image half(std::max(1, picture.width() / 2), std::max(1, picture.height() / 2), picture.channels());
  const int step_x = picture.width() > 1 ? 1 : 0;
  const int step_y = picture.height() > 1 ? 1 : 0;
  for (int y = 0; y < half.height(); ++y) {
    for (int x = 0; x < half.width(); ++x) {
      for (int c = 0; c < picture.channels(); ++c) {
        half(x, y, c) = 0.25F * (picture(2 * x, 2 * y, c) + picture(2 * x + step_x, 2 * y, c) +
                                 picture(2 * x, 2 * y + step_y, c) + picture(2 * x + step_x, 2 * y + step_y, c));
      }
    }
  }
  return half;
}

Eigen::Vector3f log_of(const float* rgb) {
  const float floor = std::exp(log_table()[0]);
  return Eigen::Vector3f(std::max(rgb[0], floor), std::max(rgb[1], floor), std::max(rgb[2], floor)).array().log();
}

float likeness(const Eigen::Vector3f& log_deviation) {
  return std::exp(-log_deviation.squaredNorm() / (kUnlikeSkin * kUnlikeSkin)) + 1e-5F;
}

// Robust mean over the middle of the square, where every layout in use has the front of the face.
Eigen::Vector3f mean_skin(const Image& linear) {
  const int x0 = linear.width() / 4;
  const int x1 = std::max(x0 + 1, linear.width() - x0);
  const int y0 = linear.height() / 10;
  const int y1 = std::max(y0 + 1, linear.height() * 7 / 10);
  std::array<std::vector<float>, 3> values;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)].push_back(linear(x, y, c));
    }
  }
  Eigen::Vector3f mean;
  for (int c = 0; c < 3; ++c) mean[c] = upper_median_of(std::move(values[static_cast<std::size_t>(c)]));
  for (int round = 0; round < 8; ++round) {
    const Eigen::Vector3f log_mean = log_of(mean.data());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weight = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const double w = static_cast<double>(likeness(log_of(linear.pixel(x, y)) - log_mean));
        sum += w * Eigen::Map<const Eigen::Vector3f>(linear.pixel(x, y)).cast<double>();
        weight += w;
      }
    }
    mean = (sum / weight).cast<float>();
  }
  return mean;
}

// Gaussian along one axis of an interleaved picture, ends repeated.
Image blur_axis(const Image& picture, bool along_x, float deviation_px) {
  const int radius = std::max(1, static_cast<int>(std::ceil(3.0F * deviation_px)));
  Image out(picture.width(), picture.height(), picture.channels());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      float total = 0;
      for (int step = -radius; step <= radius; ++step) {
        const float z = static_cast<float>(step) / deviation_px;
        const float w = std::exp(-0.5F * z * z);
        const int sx = std::clamp(along_x ? x + step : x, 0, picture.width() - 1);
        const int sy = std::clamp(along_x ? y : y + step, 0, picture.height() - 1);
        for (int c = 0; c < picture.channels(); ++c) out(x, y, c) += w * picture(sx, sy, c);
        total += w;
      }
      for (int c = 0; c < picture.channels(); ++c) out(x, y, c) /= total;
    }
  }
  return out;
}

// Deviations that vary slowly, looked at past brows, lips and beard.
Image broad_deviation(const Image& linear, const Eigen::Vector3f& mean) {
  const Eigen::Vector3f log_mean = log_of(mean.data());
  Image weighted(linear.width(), linear.height(), 4);
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      const Eigen::Vector3f deviation = log_of(linear.pixel(x, y)) - log_mean;
      const float w = likeness(deviation);
      for (int c = 0; c < 3; ++c) weighted(x, y, c) = w * deviation[c];
      weighted(x, y, 3) = w;
    }
  }
  const float side = static_cast<float>(std::max(linear.width(), linear.height()));
  weighted = blur_axis(blur_axis(weighted, true, kBroadDeviation * side), false, kBroadDeviation * side);
  Image broad(linear.width(), linear.height(), 3);
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      for (int c = 0; c < 3; ++c) broad(x, y, c) = weighted(x, y, c) / weighted(x, y, 3);
    }
  }
  return broad;
}

// Share of dark hair among moustache, chin and the sides of the mouth in the ICT layout (top-down shares of the square).
float beard_share(const Image& linear, const Eigen::Vector3f& mean) {
  struct Patch {
    float x0, x1, y0, y1;
  };
  static constexpr std::array<Patch, 4> kPatches = {{{0.42F, 0.58F, 0.47F, 0.49F},
                                                     {0.42F, 0.58F, 0.645F, 0.675F},
                                                     {0.33F, 0.37F, 0.55F, 0.63F},
                                                     {0.63F, 0.67F, 0.55F, 0.63F}}};
  const float dark = 0.65F * luminance(mean.data());
  int found = 0;
  int all = 0;
  for (const Patch& patch : kPatches) {
    for (int y = 0; y < linear.height(); ++y) {
      for (int x = 0; x < linear.width(); ++x) {
        const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(linear.width());
        const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(linear.height());
        if (u < patch.x0 || u > patch.x1 || v < patch.y0 || v > patch.y1) continue;
        ++all;
        found += luminance(linear.pixel(x, y)) < dark ? 1 : 0;
      }
    }
  }
  return all > 0 ? static_cast<float>(found) / static_cast<float>(all) : 0.0F;
}

struct Corner {
  int x0, x1, y0, y1;
  float fx, fy;
};

Corner corner_of(const Eigen::Vector2f& uv, int width, int height) {
  const float x = std::max(0.0F, uv.x() * static_cast<float>(width) - 0.5F);
  const float y = std::max(0.0F, (1.0F - uv.y()) * static_cast<float>(height) - 0.5F);
  const int x0 = std::min(static_cast<int>(x), width - 1);
  const int y0 = std::min(static_cast<int>(y), height - 1);
  return {x0,
          std::min(x0 + 1, width - 1),
          y0,
          std::min(y0 + 1, height - 1),
          x - static_cast<float>(x0),
          y - static_cast<float>(y0)};
}

template <class T, class Value>
Eigen::Vector3f bilinear(const BasicImage<T>& picture, const Eigen::Vector2f& uv, Value value) {
  const Corner at = corner_of(uv, picture.width(), picture.height());
  const T* p00 = picture.pixel(at.x0, at.y0);
  const T* p10 = picture.pixel(at.x1, at.y0);
  const T* p01 = picture.pixel(at.x0, at.y1);
  const T* p11 = picture.pixel(at.x1, at.y1);
  Eigen::Vector3f out;
  for (int c = 0; c < 3; ++c) {
    const float top = value(p00[c]) + at.fx * (value(p10[c]) - value(p00[c]));
    const float bottom = value(p01[c]) + at.fx * (value(p11[c]) - value(p01[c]));
    out[c] = top + at.fy * (bottom - top);
  }
  return out;
}

}  // namespace

SkinTexture prepare_texture(const std::string& name, ByteImage srgb) {
  if (srgb.empty() || srgb.channels() != 3) {
    throw Error(ExitCode::kInput,
                "The skin texture " + name + " is empty or has not three channels; give an RGB picture.");
  }
  SkinTexture texture;
  texture.name = name;
  Image linear = decode_srgb(srgb);
  texture.srgb = std::move(srgb);
  while (std::max(linear.width(), linear.height()) > kBroadPx) {
    linear = half_size(linear);
    texture.smaller.push_back(encode_srgb(linear));
  }
  texture.mean_skin = mean_skin(linear);
  if (!(texture.mean_skin.minCoeff() > 1e-4F)) {
    throw Error(ExitCode::kInput, "The skin texture " + name +
                                      " is black where the face should be; give one with the face in the " +
                                      "middle of the square.");
  }
  texture.beard = beard_share(linear, texture.mean_skin);
  texture.broad = broad_deviation(linear, texture.mean_skin);
  return texture;
}

TextureSample sample_texture(const SkinTexture& texture, const Eigen::Vector2f& uv, float footprint_uv) {
  const ByteImage* picture = &texture.srgb;
  const float texels = footprint_uv * static_cast<float>(picture->width());
  float limit = 1.41421F;  // half-way to the next size, in the logarithm
  for (std::size_t level = 0; level < texture.smaller.size() && texels > limit; ++level, limit *= 2.0F) {
    picture = &texture.smaller[level];
  }
  const std::array<float, 256>& logs = log_table();
  return {bilinear(*picture, uv, [&logs](std::uint8_t code) { return logs[code]; }),
          bilinear(texture.broad, uv, [](float value) { return value; })};
}

}  // namespace faceprobe::synth
