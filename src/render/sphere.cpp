#include "faceprobe/render/sphere.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::render {

namespace {

constexpr Microfacet kMatteMetal{.roughness = 0.3F, .specular_albedo = 0.25F, .f0 = 1.0F};

Eigen::RowVector3f shade(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, SphereMaterial material,
                         const Eigen::Vector3f& normal) {
  const Eigen::Vector3f view(0, 0, 1);
  if (material == SphereMaterial::kMirror) {
    const Eigen::Vector3f mirrored = 2.0F * normal.dot(view) * normal - view;
    const SphereGrid::Interpolation at = grid.interpolate(mirrored);
    Eigen::RowVector3f value = Eigen::RowVector3f::Zero();
    for (std::size_t k = 0; k < 4; ++k) value += at.weight[k] * radiance.row(at.cell[k]);
    return value;
  }
  const auto solid_angle = static_cast<float>(grid.cell_solid_angle());
  Eigen::RowVector3f sum = Eigen::RowVector3f::Zero();
  for (int j = 0; j < grid.cell_count(); ++j) {
    const Eigen::Vector3f light = grid.direction(j);
    const float cosine = normal.dot(light);
    if (cosine <= 0.0F) continue;
    const float weight = material == SphereMaterial::kDiffuse ? cosine / static_cast<float>(kPi)
                                                              : specular_lobe(normal, view, light, kMatteMetal);
    sum += weight * solid_angle * radiance.row(j);
  }
  return sum;
}

}  // namespace

std::string SphereOptions::validate() const {
  if (size_px < 1 || size_px > 8192) return "size_px must be from 1 to 8192, found " + std::to_string(size_px) + ".";
  return {};
}

Image render_sphere(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const SphereOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (radiance.rows() != grid.cell_count()) throw std::invalid_argument("A sphere needs one radiance per cell.");
  const int size = options.size_px;
  Image picture(size, size, 4);
  parallel_for(size, options.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < size; ++x) {
        float px = (2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(size)) - 1.0F;
        float py = 1.0F - (2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(size));
        const float radius = std::hypot(px, py);
        // One pixel of soft rim, shaded with the normal at the silhouette.
        const float coverage = std::clamp((1.0F - radius) * 0.5F * static_cast<float>(size) + 0.5F, 0.0F, 1.0F);
        if (coverage <= 0.0F) continue;
        const float shrink = std::min(1.0F, 0.9999F / std::max(radius, 1e-6F));
        px *= shrink;
        py *= shrink;
        const Eigen::Vector3f normal(px, py, std::sqrt(std::max(0.0F, 1.0F - px * px - py * py)));
        Eigen::Map<Eigen::RowVector3f>(picture.pixel(x, y)) =
            shade(radiance, grid, options.material, normal.normalized());
        picture(x, y, 3) = coverage;
      }
    }
  });
  return picture;
}

}  // namespace faceprobe::render
