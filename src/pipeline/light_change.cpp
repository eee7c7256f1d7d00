#include "faceprobe/pipeline/relight.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Geometry>
#include <cmath>

namespace faceprobe::pipeline {

std::string LightChange::validate() const {
  constexpr int kMostLights = 5;
  constexpr double kMostStops = 30;
  const bool has_map = map.width() > 0;
  if (dim < 0 || dim > kMostLights) return "dim must be from 0 to 5 lights, found " + std::to_string(dim) + ".";
  if (!std::isfinite(turn_deg)) return "turn must be a number of degrees.";
  if (!(std::abs(exposure) <= kMostStops))
    return "exposure must be from -30 to 30 stops, found " + std::to_string(exposure) + ".";
  if (!has_map && dim == 0 && turn_deg == 0 && exposure == 0)
    return "The light would stay as it is; give a map, lights to dim, a turn or an exposure.";
  if (has_map && dim > 0) return "dim is for the photo's own lights; leave it or the map out.";
  return {};
}

Eigen::MatrixX3f changed_light(const FaceEstimate& face, const LightChange& change, const EstimateOptions& options) {
  constexpr int kTurnWidth = 256;
  const lighting::Light& own = face.light;
  const SphereGrid grid = SphereGrid::of_cells(own.radiance.rows());
  Eigen::MatrixX3f light = own.radiance;
  if (change.dim > 0)
    light = lighting::without_main_lights(light, grid, change.dim, options.main_lights, own.confidence);
  if (change.map.width() > 0) {
    // A map has no unit that a photo shares: it gets the energy of the light that it replaces.
    const double energy = own.radiance.cast<double>().sum() * grid.cell_solid_angle();
    const double given = change.map.integral().sum();
    if (!(given > 0)) throw Error(ExitCode::kInput, "The map holds no light; choose another one.");
    light = grid_from_env_map(change.map, grid) * static_cast<float>(energy / given);
  }
  if (change.turn_deg != 0) {
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(radians(change.turn_deg)), Eigen::Vector3f::UnitY()).toRotationMatrix();
    light = grid_from_env_map(rotate(env_map_from_grid(light, grid, kTurnWidth, kTurnWidth / 2), turn), grid);
  }
  return light * static_cast<float>(std::exp2(change.exposure));
}

}  // namespace faceprobe::pipeline
