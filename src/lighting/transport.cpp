#include "faceprobe/lighting/transport.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/lighting/horizon.h"

#include <stdexcept>

namespace faceprobe::lighting {

namespace {

// Fills one row per patch with kernel(patch, direction) * visibility * solid angle, skipping cells behind the surface.
template <class Kernel>
RowMatrix fill_rows(const Observations& observations, const SphereGrid& grid, int threads, const Kernel& kernel) {
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const auto solid_angle = static_cast<float>(grid.cell_solid_angle());
  RowMatrix rows = RowMatrix::Zero(observations.count(), grid.cell_count());
  const bool shadowed = observations.horizon.rows() > 0;
  parallel_for(static_cast<int>(observations.count()), threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Eigen::Vector3f normal = observations.normal.row(i).transpose();
      const Eigen::RowVectorXf horizon = shadowed ? Eigen::RowVectorXf(observations.horizon.row(i)) : Eigen::RowVectorXf();
      for (int j = 0; j < grid.cell_count(); ++j) {
        const Eigen::Vector3f light = grid.direction(j);
        if (normal.dot(light) <= 0.0F) continue;
        float value = kernel(i, light);
        if (value <= 0.0F) continue;
        if (shadowed) value *= horizon_visibility(horizon, light);
        rows(i, j) = value * solid_angle;
      }
    }
  });
  return rows;
}

}  // namespace

RowMatrix highlight_transport(const Observations& observations, const SphereGrid& grid, int threads) {
  return fill_rows(observations, grid, threads, [&](int i, const Eigen::Vector3f& light) {
    return specular_lobe(observations.normal.row(i).transpose(), observations.view.row(i).transpose(), light,
                         {.roughness = observations.roughness[i], .specular_albedo = observations.specular_albedo[i]});
  });
}

RowMatrix diffuse_transport(const Observations& observations, const SphereGrid& grid, int threads) {
  return fill_rows(observations, grid, threads, [&](int i, const Eigen::Vector3f& light) {
    return observations.normal.row(i).dot(light) / static_cast<float>(kPi);
  });
}

}  // namespace faceprobe::lighting
