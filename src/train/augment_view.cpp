#include "train/augment_view.h"

#include "faceprobe/core/region.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

void put_outside(TrainingPicture& picture, int x, int y) {
  std::fill_n(picture.linear.pixel(x, y), 3, 0.0F);
  std::fill_n(picture.highlight.pixel(x, y), 3, 0.0F);
  std::fill_n(picture.clip.pixel(x, y), 3, std::uint8_t{1});
  picture.skin(x, y) = 0;
  if (!picture.has_surface()) return;
  picture.region(x, y) = static_cast<std::uint8_t>(Region::kNone);
  std::fill_n(picture.shading.pixel(x, y), 3, 0.0F);
  std::fill_n(picture.open.pixel(x, y), 3, 0.0F);
}

}  // namespace

Window zoom_window(const TrainingPicture& picture, double zoom, double centre_x, double centre_y) {
  return {centre_x - centre_x / zoom, centre_y - centre_y / zoom, zoom, picture.linear.width(), picture.linear.height()};
}

TrainingPicture seen_through(const Window& window, const TrainingPicture& picture) {
  constexpr std::uint8_t kNoPicture = 255;
  const ByteImage there = resampled(ByteImage(picture.linear.width(), picture.linear.height(), 1), window, kNoPicture);
  TrainingPicture out;
  out.linear = resampled(picture.linear, window);
  out.highlight = resampled(picture.highlight, window);
  out.clip = resampled(picture.clip, window);
  out.mask = resampled(picture.mask, window);
  out.skin = resampled(picture.skin, window);
  if (picture.has_surface()) {
    out.mesh = resampled(picture.mesh, window);
    out.normal = resampled(picture.normal, window);
    // Between a face and what is not known about its surroundings there is nothing to interpolate.
    out.depth_m = nearest(picture.depth_m, window);
    out.shading = nearest(picture.shading, window);
    out.open = nearest(picture.open, window);
    out.region = resampled(picture.region, window);
  }
  for (std::size_t i = 0; i < out.linear.values().size(); ++i)
    out.highlight.data()[i] = std::min(out.highlight.data()[i], out.linear.data()[i]);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      if (there(x, y) == kNoPicture) put_outside(out, x, y);
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
