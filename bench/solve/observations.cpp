#include "solve/observations.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/transport.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {
namespace {

constexpr int kTruthNside = 32;
constexpr double kNoise = 0.03;
constexpr double kLampRadius = 12;  // degrees
constexpr float kSurround = 0.2F;   // radiance; the lamp's irradiance is 1

// Normals that a distant camera sees of an ellipsoid, half axes 75, 100 and 80 mm.
Eigen::MatrixX3f ellipsoid_normals(int patches) {
  constexpr double kSeen = 0.95;  // of the outline's squared radius: no patch is seen edge-on
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  Eigen::MatrixX3f normals(patches, 3);
  for (int i = 0; i < patches; ++i) {
    const double radius = std::sqrt(kSeen * (i + 0.5) / patches);
    const double x = radius * std::cos(golden_angle * i);
    const double y = radius * std::sin(golden_angle * i);
    const double z = std::sqrt(1 - x * x - y * y);
    normals.row(i) = Eigen::RowVector3d(x / 0.75, y / 1.0, z / 0.8).normalized().cast<float>();
  }
  return normals;
}

// A body without hollows hides nothing from a patch but what is below its tangent plane.
Eigen::MatrixXf tangent_horizon(const Eigen::MatrixX3f& normals) {
  Eigen::MatrixXf horizon(normals.rows(), lighting::kHorizonAzimuths);
  for (int k = 0; k < lighting::kHorizonAzimuths; ++k) {
    const auto azimuth = static_cast<float>(2 * kPi * k / lighting::kHorizonAzimuths);
    horizon.col(k) =
        -(normals.col(0) * std::cos(azimuth) + normals.col(1) * std::sin(azimuth)).cwiseQuotient(normals.col(2));
  }
  return horizon;
}

Eigen::MatrixX3f truth(const SphereGrid& grid) {
  const Eigen::Vector3f lamp = solve_lamp();
  const auto least = static_cast<float>(std::cos(radians(kLampRadius)));
  const Eigen::Array<bool, Eigen::Dynamic, 1> inside = (grid.directions() * lamp).array() >= least;
  const float each = 1.0F / static_cast<float>(static_cast<double>(inside.count()) * grid.cell_solid_angle());
  Eigen::MatrixX3f radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, kSurround);
  for (Eigen::Index j = 0; j < radiance.rows(); ++j) {
    if (inside[j]) radiance.row(j) += each * Eigen::RowVector3f(1.1F, 1.0F, 0.8F);
  }
  return radiance;
}

void add_noise(Random& random, Eigen::MatrixX3f& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values(i) = std::max(0.0F, values(i) * static_cast<float>(random.normal(1, kNoise)));
}

}  // namespace

Eigen::Vector3f solve_lamp() { return Eigen::Vector3f(0.5F, 0.4F, 0.77F).normalized(); }

lighting::Observations solve_observations(int patches) {
  lighting::Observations face;
  face.resize(patches);
  face.normal = ellipsoid_normals(patches);
  face.view.rowwise() = Eigen::RowVector3f(0, 0, 1);
  face.horizon = tangent_horizon(face.normal);
  const SphereGrid grid(kTruthNside);
  const Eigen::MatrixX3f light = truth(grid);
  {
    const lighting::Transport transport = lighting::build_transport(face, grid);
    face.highlight = transport.highlight() * light;
    face.shading = transport.diffuse() * light;
  }
  Random random({29, static_cast<std::uint64_t>(patches)});
  add_noise(random, face.highlight);
  add_noise(random, face.shading);
  return face;
}

}  // namespace faceprobe::bench
