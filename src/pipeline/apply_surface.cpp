#include "pipeline/apply_surface.h"

#include <algorithm>

namespace faceprobe::pipeline {

void apply_normals(const Surface& surface, face::FaceGeometry& geometry) {
  const int width = geometry.region.width();
  const int height = geometry.region.height();
  const Eigen::Matrix3f turn = camera_from_network(geometry);
  geometry.normal_error_rad = surface.normal_error_rad;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (geometry.region(x, y) == 0) continue;
      Eigen::Map<Eigen::Vector3f>(geometry.normal_cam.pixel(x, y)) =
          turn * Eigen::Map<const Eigen::Vector3f>(surface.normal_cam.pixel(x, y));
    }
  }
}

void apply_regions(const Surface& surface, face::FaceGeometry& geometry) {
  for (std::size_t i = 0; i < geometry.region.pixel_count(); ++i) {
    if (geometry.region.data()[i] != 0) geometry.region.data()[i] = surface.region.data()[i];
  }
}

AlbedoShading split_diffuse(const Image& shading, const Image& diffuse, const ByteImage& skin) {
  constexpr float kDarkest = 1e-4F;
  AlbedoShading out{Image(diffuse.width(), diffuse.height(), 3), Image(diffuse.width(), diffuse.height(), 3),
                    Eigen::Vector3f::Ones()};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < skin.values().size(); ++i) {
    const float* light = shading.data() + 3 * i;
    for (std::size_t c = 0; c < 3; ++c) {
      out.albedo.data()[3 * i + c] = diffuse.data()[3 * i + c] / std::max(kDarkest, light[c]);
      if (skin.data()[i] != 0) out.shading.data()[3 * i + c] = light[c];
    }
    if (skin.data()[i] != 0) sum += Eigen::Map<const Eigen::Vector3f>(light).cast<double>();
  }
  if (sum.y() > 0) out.light_colour = (sum / sum.y()).cast<float>();
  return out;
}

}  // namespace faceprobe::pipeline
