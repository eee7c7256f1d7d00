#include "train/augment_view.h"

#include "faceprobe/core/region.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

// Between the centres of four pixels; a pixel outside is black.
float between(const Image& image, double x, double y, int channel) {
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const double fx = x - 0.5 - left;
  const double fy = y - 0.5 - top;
  const auto at = [&](double px, double py) {
    const auto ix = static_cast<int>(px);
    const auto iy = static_cast<int>(py);
    if (ix < 0 || iy < 0 || ix >= image.width() || iy >= image.height()) return 0.0;
    return static_cast<double>(image(ix, iy, channel));
  };
  return static_cast<float>((1 - fy) * ((1 - fx) * at(left, top) + fx * at(left + 1, top)) +
                            fy * ((1 - fx) * at(left, top + 1) + fx * at(left + 1, top + 1)));
}

void put_outside(TrainingPicture& picture, int x, int y) {
  std::fill_n(picture.linear.pixel(x, y), 3, 0.0F);
  std::fill_n(picture.highlight.pixel(x, y), 3, 0.0F);
  std::fill_n(picture.clip.pixel(x, y), 3, std::uint8_t{1});
  picture.skin(x, y) = 0;
  if (!picture.has_surface()) return;
  picture.region(x, y) = static_cast<std::uint8_t>(Region::kNone);
  std::fill_n(picture.shading.pixel(x, y), 3, 0.0F);
}

}  // namespace

TrainingPicture zoomed(const TrainingPicture& picture, double zoom, double centre_x, double centre_y) {
  const int width = picture.linear.width();
  const int height = picture.linear.height();
  TrainingPicture out;
  out.linear = out.highlight = Image(width, height, 3);
  out.clip = ByteImage(width, height, 3);
  out.mask = out.skin = ByteImage(width, height, 1);
  if (picture.has_surface()) {
    out.mesh = out.normal = out.shading = Image(width, height, 3);
    out.depth_m = Image(width, height, 1);
    out.region = ByteImage(width, height, 1);
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double from_x = centre_x + (x + 0.5 - centre_x) / zoom;
      const double from_y = centre_y + (y + 0.5 - centre_y) / zoom;
      const auto ix = static_cast<int>(std::floor(from_x));
      const auto iy = static_cast<int>(std::floor(from_y));
      const int inner_x = std::clamp(ix, 0, width - 1);
      const int inner_y = std::clamp(iy, 0, height - 1);
      out.mask(x, y) = picture.mask(inner_x, inner_y);
      if (ix != inner_x || iy != inner_y) {
        put_outside(out, x, y);
        continue;
      }
      for (int c = 0; c < 3; ++c) {
        const float light = between(picture.linear, from_x, from_y, c);
        out.linear(x, y, c) = light;
        out.highlight(x, y, c) = std::min(light, between(picture.highlight, from_x, from_y, c));
      }
      std::copy_n(picture.clip.pixel(ix, iy), 3, out.clip.pixel(x, y));
      out.skin(x, y) = picture.skin(ix, iy);
      if (!picture.has_surface()) continue;
      out.region(x, y) = picture.region(ix, iy);
      out.depth_m(x, y) = picture.depth_m(ix, iy);
      std::copy_n(picture.shading.pixel(ix, iy), 3, out.shading.pixel(x, y));
      for (int c = 0; c < 3; ++c) {
        out.normal(x, y, c) = between(picture.normal, from_x, from_y, c);
        out.mesh(x, y, c) = between(picture.mesh, from_x, from_y, c);
      }
    }
  }
  return out;
}

void cut_sides(const ShownPart& shown, TrainingPicture& picture) {
  for (int y = 0; y < picture.linear.height(); ++y) {
    for (int x = 0; x < picture.linear.width(); ++x) {
      const bool inside = x >= shown.left && x < shown.right && y >= shown.top && y < shown.bottom;
      if (!inside) put_outside(picture, x, y);
    }
  }
}

}  // namespace faceprobe::train
