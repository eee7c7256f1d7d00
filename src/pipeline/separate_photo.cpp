#include "faceprobe/pipeline/observe.h"
#include "pipeline/camera_of.h"
#include "pipeline/estimator_impl.h"
#include "pipeline/face_warnings.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {

namespace {

// The face's crop at the photo's own resolution, on whole pixels, so that layers go back without resampling.
face::Crop full_crop(const face::Crop& wide, int width, int height) {
  const int left = std::max(0, static_cast<int>(std::floor(wide.x_px)));
  const int top = std::max(0, static_cast<int>(std::floor(wide.y_px)));
  const int right = std::min(width, static_cast<int>(std::ceil(wide.x_px + wide.width / wide.scale)));
  const int bottom = std::min(height, static_cast<int>(std::ceil(wide.y_px + wide.height / wide.scale)));
  return {.x_px = static_cast<double>(left),
          .y_px = static_cast<double>(top),
          .scale = 1.0,
          .width = std::max(0, right - left),
          .height = std::max(0, bottom - top)};
}

template <class T>
BasicImage<T> cut(const BasicImage<T>& photo, int left, int top, const face::Crop& crop) {
  BasicImage<T> out(crop.width, crop.height, photo.channels());
  for (int y = 0; y < crop.height; ++y) std::copy_n(photo.pixel(left, top + y), out.row(y).size(), out.pixel(0, y));
  return out;
}

}  // namespace

highlight::Layers Estimator::separate(const io::Photo& photo) const {
  const face::Camera camera = camera_of(photo, impl_->options).camera;
  const std::vector<face::Face> faces = impl_->faces_of(photo, camera);
  if (faces.empty()) throw no_face(photo, impl_->options);
  highlight::Layers whole;
  whole.highlight = Image(photo.linear.width(), photo.linear.height(), 3);
  whole.diffuse = photo.linear;
  for (const face::Face& face : faces) {
    const face::Crop wide = face::face_crop(face, photo.linear.width(), photo.linear.height(), {});
    const face::Crop crop = full_crop(wide, photo.linear.width(), photo.linear.height());
    if (crop.width == 0 || crop.height == 0) continue;
    const int left = static_cast<int>(crop.x_px);
    const int top = static_cast<int>(crop.y_px);
    const Image picture = cut(photo.linear, left, top, crop);
    const ByteImage skin = skin_regions(face::rasterize_regions(face, camera, impl_->mesh, crop));
    const face::FaceGeometry geometry = face::rasterize(face, camera, impl_->mesh, small_crop(crop));
    const bool enough = shown_share(wide, photo.linear.width(), photo.linear.height()) >= impl_->options.least_shown;
    const highlight::Layers layers =
        impl_->reader.separate(picture, cut(photo.clipped, left, top, crop), skin, geometry, enough);
    for (int y = 0; y < crop.height; ++y) {
      for (int x = 0; x < crop.width; ++x) {
        if (skin(x, y) == 0) continue;
        std::copy_n(layers.highlight.pixel(x, y), 3, whole.highlight.pixel(left + x, top + y));
        std::copy_n(layers.diffuse.pixel(x, y), 3, whole.diffuse.pixel(left + x, top + y));
      }
    }
  }
  return whole;
}

}  // namespace faceprobe::pipeline
