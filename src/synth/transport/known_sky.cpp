#include "synth/transport/known_sky.h"

#include "faceprobe/core/angles.h"

#include <cmath>

namespace faceprobe::synth {

KnownSky::KnownSky(const SceneTransport& transport, const SphereGrid& grid, const Eigen::Vector3f& direction)
    : transport_(transport) {
  constexpr int kLeastNside = 16;
  if (transport.nside < kLeastNside) return;
  const double width = std::sqrt(4.0 * kPi / static_cast<double>(grid.cell_count()));
  const auto least = static_cast<float>(std::cos(1.3 * width));  // the light's cell and all that touch it
  const Eigen::VectorXf cosine = grid.directions() * direction;
  for (Eigen::Index cell = 0; cell < cosine.size(); ++cell) {
    if (cosine(cell) > least) cells_.push_back(static_cast<int>(cell));
  }
}

}  // namespace faceprobe::synth
