#pragma once
// Internal: the glow that a solver spreads the dominant light over, and the map as shapes with and without it (compact_fit.h).

#include "faceprobe/lighting/estimate.h"

#include <optional>

namespace faceprobe::lighting {

struct Glow {
  Eigen::Vector3d towards;  // unit: the light's middle
  Eigen::MatrixXf
      shapes;  // #cells x kUnknowns (robust_rows.h), luminance: map without the glow; smooth light from six sides; the glow
};

// Of what was seen, around the direction from where most light above the map's median comes; it ends where the rings around that hardly fall any more.
// Nothing where no light stands out. `level`: #cells, luminance; `ambient`: its median.
std::optional<Glow> find_glow(const Eigen::VectorXf& level, float ambient, const Eigen::VectorXf& confidence,
                              const SphereGrid& grid);

// #cells, from a direction of unit length.
Eigen::VectorXf angles_deg(const SphereGrid& grid, const Eigen::Vector3d& towards);

}  // namespace faceprobe::lighting
