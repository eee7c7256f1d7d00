#include "highlight/skin_pixel.h"

#include "faceprobe/core/sh.h"

#include <algorithm>

namespace faceprobe::highlight {
namespace {

constexpr float kBrightest = 1e30F;  // sums stay finite below it
constexpr float kLeastFacing = 0.05F;

void set_normal(const Image& normal_cam, int x, int y, SkinPixel& pixel) {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  if (!normal_cam.empty()) normal = Eigen::Map<const Eigen::Vector3f>(normal_cam.pixel(x, y));
  const float length = normal.norm();
  if (!(length > 0) || length > kBrightest) {
    pixel.normal_basis.setZero();
    pixel.normal_basis[0] = static_cast<float>(sh::basis(0, Eigen::Vector3d::UnitZ())[0]);
    pixel.mirror_basis = pixel.normal_basis;
    return;
  }
  const Eigen::Vector3d n = normal.cast<double>().normalized();
  pixel.normal_basis = sh::basis(2, n).cast<float>();
  // A face is small and far: the viewer is taken to be at +z for all of it.
  pixel.mirror_basis = sh::basis(2, 2 * n.z() * n - Eigen::Vector3d::UnitZ()).cast<float>();
  pixel.facing = std::max(kLeastFacing, static_cast<float>(n.z()));
}

}  // namespace

std::vector<SkinPixel> skin_pixels(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                                   const Image& normal_cam) {
  std::vector<SkinPixel> pixels;
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) {
      if (!mask.empty() && mask(x, y) == 0) continue;
      SkinPixel pixel;
      pixel.index = static_cast<std::size_t>(y) * static_cast<std::size_t>(linear.width()) + static_cast<std::size_t>(x);
      const unsigned clipped = clip.empty() ? 0U : clip(x, y);
      for (int c = 0; c < 3; ++c) {
        const float value = linear(x, y, c);
        pixel.colour[c] = value > 0 && value < kBrightest ? value : 0.0F;
        pixel.used[c] = pixel.colour[c] > 0 && (clipped >> c & 1U) == 0;
      }
      if (pixel.colour.maxCoeff() <= 0) continue;
      pixel.shading.setZero();
      pixel.light.setOnes();
      pixel.around.setZero();
      pixel.own.setZero();
      set_normal(normal_cam, x, y, pixel);
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

}  // namespace faceprobe::highlight
