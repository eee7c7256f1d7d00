#include "faceprobe/pipeline/relight.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "pipeline/dimmed_lights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {
namespace {

constexpr int kMostLights = lighting::MainLightOptions{}.max_lights;

// Of the main lights in their order. Throws std::out_of_range for lights that do not validate.
std::vector<double> shares_of(const std::vector<DimmedLight>& dim) {
  std::vector<double> shares(kMostLights, 0.0);
  for (const DimmedLight& dimmed : dim) shares.at(static_cast<std::size_t>(dimmed.light - 1)) = dimmed.share;
  while (!shares.empty() && shares.back() == 0) shares.pop_back();  // each costs a search for lights
  return shares;
}

}  // namespace

std::string LightChange::validate() const {
  constexpr double kMostStops = 30;
  const bool has_map = map.width() > 0;
  for (auto dimmed = dim.begin(); dimmed != dim.end(); ++dimmed) {
    const std::string number = std::to_string(dimmed->light);
    if (dimmed->light < 1 || dimmed->light > kMostLights)
      return "Lights to dim are numbered from 1, the strongest, to " + std::to_string(kMostLights) + "; found " +
             number + ".";
    if (!(dimmed->share > 0 && dimmed->share <= 1))
      return "The share of light " + number + " that goes must be above 0 and at most 1, found " +
             std::to_string(dimmed->share) + ".";
    if (std::any_of(dim.begin(), dimmed, [&](const DimmedLight& other) { return other.light == dimmed->light; }))
      return "Light " + number + " is dimmed twice; name it once.";
  }
  if (!std::isfinite(turn_deg)) return "turn must be a number of degrees.";
  if (!(std::abs(exposure) <= kMostStops))
    return "exposure must be from -30 to 30 stops, found " + std::to_string(exposure) + ".";
  if (!has_map && dim.empty() && turn_deg == 0 && exposure == 0)
    return "The light would stay as it is; give a map, lights to dim, a turn or an exposure.";
  if (has_map && !dim.empty()) return "dim is for the photo's own lights; leave it or the map out.";
  return {};
}

std::string LightChange::fault_of(const Estimate& estimate) const {
  if (std::string fault = validate(); !fault.empty()) return fault;
  std::size_t most = 0;
  for (const FaceEstimate& face : estimate.faces) most = std::max(most, face.lights.size());
  for (const DimmedLight& dimmed : dim) {
    if (static_cast<std::size_t>(dimmed.light) > most)
      return "The photo's faces have " + std::to_string(most) + " main lights at most, and light " +
             std::to_string(dimmed.light) + " cannot be dimmed; report.json of `faceprobe estimate` lists them.";
  }
  return {};
}

Eigen::MatrixX3f changed_light(const FaceEstimate& face, const LightChange& change, const EstimateOptions& options) {
  constexpr int kTurnWidth = 256;
  const lighting::Light& own = face.light;
  const SphereGrid grid = SphereGrid::of_cells(own.radiance.rows());
  Eigen::MatrixX3f light = own.radiance;
  if (!change.dim.empty())
    light = dimmed_lights(light, grid, shares_of(change.dim), options.main_lights, own.confidence);
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
