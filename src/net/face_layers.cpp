#include "net/face_layers.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/mirror.h"
#include "net/face_outputs.h"
#include "net/head.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::net {
namespace {

using Out = FaceOutputs;

float limited(float raw, double most) { return std::clamp(raw, static_cast<float>(-most), static_cast<float>(most)); }

Eigen::Vector3f normal_of(const float* raw) {
  Eigen::Vector3f free;
  for (int c = 0; c < 3; ++c) free[c] = limited(raw[Out::kNormal + c], Head::kLargestRaw);
  free.z() += 1;
  return free / std::max(free.norm(), static_cast<float>(Out::kShortest));
}

// Of four channels: a level and a colour.
Eigen::Array3f light_of(const float* raw) {
  Eigen::Array3f colour;
  for (int c = 0; c < 3; ++c)
    colour[c] = softplus(limited(raw[1 + c], Head::kLargestRaw)) + static_cast<float>(Head::kColourFloor);
  return std::exp(limited(raw[0], Out::kLargestLog)) * colour / colour.mean();
}

Image mean_of(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < a.values().size(); ++i) mean.data()[i] = 0.5F * (a.data()[i] + b.data()[i]);
  return mean;
}

// Of a layer that not every network has.
Image seen_back_if_there(const Image& part, const Window& back) {
  return part.empty() ? Image() : resampled(part, back, Outside::kEdge);
}

void make_unit(Image& normals) {
  for (std::size_t i = 0; i < normals.values().size(); i += 3) {
    Eigen::Map<Eigen::Vector3f> normal(normals.data() + i);
    normal /= std::max(normal.norm(), static_cast<float>(Out::kShortest));
  }
}

double mean_where(const Image& values, const ByteImage& where) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < values.values().size(); ++i) {
    if (where.data()[i] == 0) continue;
    sum += static_cast<double>(values.data()[i]);
    ++count;
  }
  return sum / std::max(1.0, count);
}

template <class T>
void put_pixel(const BasicImage<T>& from, int x, int y, BasicImage<T>& to) {
  std::copy_n(from.pixel(x, y), from.channels(), to.pixel(x, y));
}

}  // namespace

FaceInputPicture face_input(const PaddedPicture& picture, const Image& mesh) {
  double sum = 0;
  double count = 0;
  const bool masked = std::ranges::any_of(picture.mask.values(), [](float m) { return m > 0; });
  for (std::size_t i = 0; i < picture.mask.values().size(); ++i) {
    if (masked && picture.mask.data()[i] == 0) continue;
    sum += std::clamp(static_cast<double>(luminance(picture.linear.data() + 3 * i)), 0.0, Head::kBrightest);
    ++count;
  }
  const double mean = sum / std::max(1.0, count);
  const auto gain = static_cast<float>(FaceInputs::kMiddle / std::max(FaceInputs::kDarkest, mean));
  PaddedPicture scaled = picture;
  for (float& light : scaled.linear.values()) light *= gain;
  const Image plain = network_input(scaled);
  FaceInputPicture input{Image(plain.width(), plain.height(), FaceInputs::kCount), gain};
  for (int y = 0; y < plain.height(); ++y) {
    for (int x = 0; x < plain.width(); ++x) {
      float* to = std::copy_n(plain.pixel(x, y), kInputChannels, input.channels.pixel(x, y));
      if (mesh.empty()) continue;
      std::copy_n(mesh.pixel(std::min(x, mesh.width() - 1), std::min(y, mesh.height() - 1)), 3, to);
    }
  }
  return input;
}

FaceLayers surface_of_raw(const Image& raw, float gain, int width, int height) {
  FaceLayers layers{.highlight = {},
                    .normal_cam = Image(width, height, 3),
                    .normal_error_rad = Image(width, height, 1),
                    .depth_m = Image(width, height, 1),
                    .shading = Image(width, height, 3),
                    .region = ByteImage(width, height, 1),
                    .open_shading = raw.channels() == Out::kCount ? Image(width, height, 3) : Image()};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float* from = raw.pixel(x, y);
      Eigen::Map<Eigen::Vector3f>(layers.normal_cam.pixel(x, y)) = normal_of(from);
      Eigen::Map<Eigen::Array3f>(layers.shading.pixel(x, y)) = light_of(from + Out::kShading) / gain;
      if (!layers.open_shading.empty())
        Eigen::Map<Eigen::Array3f>(layers.open_shading.pixel(x, y)) = light_of(from + Out::kOpen) / gain;
      layers.normal_error_rad(x, y) =
          static_cast<float>(Out::kUsualError) * std::exp(limited(from[Out::kSpread], Out::kLargestLog));
      layers.depth_m(x, y) = static_cast<float>(Out::kDepthUnit) * from[Out::kDepth];
      const float* scores = from + Out::kRegion;
      layers.region(x, y) = static_cast<std::uint8_t>(std::max_element(scores, scores + kRegionCount) - scores);
    }
  }
  return layers;
}

FaceLayers mean_of(const FaceLayers& a, const FaceLayers& b) {
  FaceLayers mean{.highlight = mean_of(a.highlight, b.highlight),
                  .normal_cam = mean_of(a.normal_cam, b.normal_cam),
                  .normal_error_rad = mean_of(a.normal_error_rad, b.normal_error_rad),
                  .depth_m = mean_of(a.depth_m, b.depth_m),
                  .shading = mean_of(a.shading, b.shading),
                  .region = a.region,
                  .open_shading = mean_of(a.open_shading, b.open_shading)};
  make_unit(mean.normal_cam);
  return mean;
}

FaceLayers seen_back(const FaceLayers& part, const Window& window, int width, int height) {
  const Window back = window.back_to(width, height);
  FaceLayers seen{.highlight = resampled(part.highlight, back, Outside::kEdge),
                  .normal_cam = resampled(part.normal_cam, back, Outside::kEdge),
                  .normal_error_rad = resampled(part.normal_error_rad, back, Outside::kEdge),
                  .depth_m = resampled(part.depth_m, back, Outside::kEdge),
                  .shading = resampled(part.shading, back, Outside::kEdge),
                  .region = resampled(part.region, back),
                  .open_shading = seen_back_if_there(part.open_shading, back)};
  make_unit(seen.normal_cam);
  return seen;
}

void put_near(const FaceLayers& near, const Window& window, const ByteImage& where, FaceLayers& whole) {
  const int width = whole.region.width();
  const int height = whole.region.height();
  const FaceLayers seen = seen_back(near, window, width, height);
  const auto shift = static_cast<float>(mean_where(whole.depth_m, where) - mean_where(seen.depth_m, where));
  for (int y = 0; y < height; ++y) {
    const double down = (y + 0.5 - window.top_px) * window.scale;
    for (int x = 0; x < width; ++x) {
      const double across = (x + 0.5 - window.left_px) * window.scale;
      if (!(across > 0 && across < window.width && down > 0 && down < window.height)) continue;
      put_pixel(seen.highlight, x, y, whole.highlight);
      put_pixel(seen.normal_cam, x, y, whole.normal_cam);
      put_pixel(seen.normal_error_rad, x, y, whole.normal_error_rad);
      whole.depth_m(x, y) = seen.depth_m(x, y) + shift;
      put_pixel(seen.shading, x, y, whole.shading);
      if (!seen.open_shading.empty()) put_pixel(seen.open_shading, x, y, whole.open_shading);
      put_pixel(seen.region, x, y, whole.region);
    }
  }
}

Image mirrored_normals(Image normals) {
  mirror(normals);
  for (std::size_t i = 0; i < normals.values().size(); i += 3) normals.data()[i] *= -1;
  return normals;
}

void mirror(FaceLayers& layers) {
  mirror(layers.highlight);
  layers.normal_cam = mirrored_normals(std::move(layers.normal_cam));
  mirror(layers.normal_error_rad);
  mirror(layers.depth_m);
  mirror(layers.shading);
  if (!layers.open_shading.empty()) mirror(layers.open_shading);
  mirror(layers.region);
}

}  // namespace faceprobe::net
