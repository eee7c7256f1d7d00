#include "pipeline/dimmed_lights.h"

#include <cstddef>

namespace faceprobe::pipeline {

Eigen::MatrixX3f dimmed_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid,
                               const std::vector<double>& shares, const lighting::MainLightOptions& options,
                               const Eigen::VectorXf& confidence) {
  Eigen::MatrixX3f dimmed = radiance;
  Eigen::MatrixX3f with = radiance;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    // No cell belongs to two lights, so the cells that one light more changes are that light's.
    Eigen::MatrixX3f without =
        lighting::without_main_lights(radiance, grid, static_cast<int>(k) + 1, options, confidence);
    const auto share = static_cast<float>(shares[k]);
    for (Eigen::Index j = 0; j < radiance.rows(); ++j) {
      if (share > 0 && without.row(j) != with.row(j))
        dimmed.row(j) = (1 - share) * radiance.row(j) + share * without.row(j);
    }
    with.swap(without);
  }
  return dimmed;
}

}  // namespace faceprobe::pipeline
