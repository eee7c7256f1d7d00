#include "pipeline/canvas.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/face/region.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {

namespace {

void blend(ByteImage& canvas, int x, int y, const Colour& colour, float amount) {
  if (x < 0 || y < 0 || x >= canvas.width() || y >= canvas.height() || amount <= 0.0F) return;
  for (int c = 0; c < 3; ++c) {
    const auto old = static_cast<float>(canvas(x, y, c));
    const float mixed = old + amount * (static_cast<float>(colour[static_cast<std::size_t>(c)]) - old);
    canvas(x, y, c) = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0F, 255.0F)));
  }
}

}  // namespace

void paste(ByteImage& canvas, const ByteImage& picture, int x, int y) {
  for (int row = 0; row < picture.height(); ++row) {
    for (int column = 0; column < picture.width(); ++column) {
      const int cx = x + column;
      const int cy = y + row;
      if (cx < 0 || cy < 0 || cx >= canvas.width() || cy >= canvas.height()) continue;
      std::copy_n(picture.pixel(column, row), 3, canvas.pixel(cx, cy));
    }
  }
}

void draw_line(ByteImage& canvas, Eigen::Vector2d from, Eigen::Vector2d to, const Colour& colour, float opacity) {
  // Steps along the longer axis, coverage split between the two pixels across it (Wu 1991).
  const bool steep = std::abs(to.y() - from.y()) > std::abs(to.x() - from.x());
  if (steep) {
    std::swap(from.x(), from.y());
    std::swap(to.x(), to.y());
  }
  if (from.x() > to.x()) std::swap(from, to);
  const double length = to.x() - from.x();
  const double slope = length > 0 ? (to.y() - from.y()) / length : 0.0;
  // Only what is on the canvas: landmarks may be given anywhere.
  const double along = steep ? canvas.height() : canvas.width();
  const double beside = steep ? canvas.width() : canvas.height();
  const int first = static_cast<int>(std::floor(std::clamp(from.x(), 0.0, along)));
  const int last = static_cast<int>(std::floor(std::clamp(to.x(), -1.0, along - 1)));
  for (int i = first; i <= last; ++i) {
    const double across = from.y() + slope * (std::clamp<double>(i + 0.5, from.x(), to.x()) - from.x()) - 0.5;
    if (!(across > -2 && across < beside + 1)) continue;
    const int low = static_cast<int>(std::floor(across));
    const auto fraction = static_cast<float>(across - low);
    blend(canvas, steep ? low : i, steep ? i : low, colour, opacity * (1.0F - fraction));
    blend(canvas, steep ? low + 1 : i, steep ? i : low + 1, colour, opacity * fraction);
  }
}

void draw_ring(ByteImage& canvas, Eigen::Vector2d centre, double radius, const Colour& colour, float opacity) {
  constexpr int kSides = 48;
  for (int i = 0; i < kSides; ++i) {
    const auto at = [&](int k) -> Eigen::Vector2d {
      const double a = 2.0 * kPi * k / kSides;
      return centre + radius * Eigen::Vector2d(std::cos(a), std::sin(a));
    };
    draw_line(canvas, at(i), at(i + 1), colour, opacity);
  }
}

void fill(ByteImage& canvas, int x, int y, int width, int height, const Colour& colour) {
  for (int row = y; row < y + height; ++row) {
    for (int column = x; column < x + width; ++column) blend(canvas, column, row, colour, 1.0F);
  }
}

Image resized(const Image& image, int width, int height) {
  face::Crop crop;  // the whole picture as a crop of itself; the two scales may differ by a rounded pixel
  crop.scale = static_cast<double>(width) / image.width();
  crop.width = width;
  crop.height = height;
  return face::crop_picture(image, crop);
}

ByteImage resized_labels(const ByteImage& labels, int width, int height) {
  ByteImage out(width, height, labels.channels());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int sx = std::min(labels.width() - 1, static_cast<int>((x + 0.5) * labels.width() / width));
      const int sy = std::min(labels.height() - 1, static_cast<int>((y + 0.5) * labels.height() / height));
      std::copy_n(labels.pixel(sx, sy), labels.channels(), out.pixel(x, y));
    }
  }
  return out;
}

float display_gain(const Image& layer) {
  std::vector<float> values;
  for (int y = 0; y < layer.height(); ++y) {
    for (int x = 0; x < layer.width(); ++x) {
      const float* p = layer.pixel(x, y);
      const float value = layer.channels() >= 3 ? luminance(p) : p[0];
      if (value > 0) values.push_back(value);
    }
  }
  if (values.empty()) return 1.0F;
  return 0.8F / quantile_of(std::move(values), 0.99);
}

ByteImage normals_picture(const face::FaceGeometry& geometry) {
  const Image& normals = geometry.normal_cam;
  ByteImage out(normals.width(), normals.height(), 3);
  for (int y = 0; y < normals.height(); ++y) {
    for (int x = 0; x < normals.width(); ++x) {
      if (geometry.region(x, y) == 0) continue;
      for (int c = 0; c < 3; ++c) {
        out(x, y, c) =
            static_cast<std::uint8_t>(std::lround(std::clamp(127.5F * (normals(x, y, c) + 1.0F), 0.0F, 255.0F)));
      }
    }
  }
  return out;
}

ByteImage regions_picture(const face::FaceGeometry& geometry) {
  ByteImage out(geometry.region.width(), geometry.region.height(), 3);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const Colour colour = region_colour(static_cast<Region>(geometry.region(x, y)));
      std::copy_n(colour.data(), 3, out.pixel(x, y));
    }
  }
  return out;
}

}  // namespace faceprobe::pipeline
