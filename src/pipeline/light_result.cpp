#include "pipeline/light_result.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/region.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/lighting/rate_main_lights.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::pipeline {

namespace {

double energy(const lighting::Light& light) { return (light.radiance * kLuminanceWeights).cast<double>().sum(); }

lighting::Observations thinned(const lighting::Observations& all, Eigen::Index kept, Eigen::Index step) {
  const auto rows = Eigen::seqN(Eigen::Index{0}, kept, step);
  lighting::Observations set;
  set.normal = all.normal(rows, Eigen::all);
  set.view = all.view(rows, Eigen::all);
  set.highlight = all.highlight(rows, Eigen::all);
  set.shading = all.shading(rows, Eigen::all);
  if (all.open_shading.rows() > 0) set.open_shading = all.open_shading(rows, Eigen::all);
  set.clipped = all.clipped(rows, Eigen::all);
  set.roughness = all.roughness(rows);
  set.specular_albedo = all.specular_albedo(rows);
  set.weight = all.weight(rows);
  if (all.horizon.rows() > 0) set.horizon = all.horizon(rows, Eigen::all);
  set.grey = all.grey;
  return set;
}

}  // namespace

LightResult light_result(lighting::Light light, const EstimateOptions& options) {
  const SphereGrid grid(options.solve.nside);
  LightResult result;
  if (light.compact) {
    // Drawn on the map itself, whose texels are finer than cells: shadows and reflections are sharp.
    const Eigen::MatrixX3f rest =
        (light.radiance - lighting::compact_cells(*light.compact, grid)).cwiseMax(0.0F);  // rounding
    result.environment = env_map_from_grid(rest, grid, options.map_width, options.map_width / 2);
    lighting::add_compact_light(*light.compact, result.environment);
  } else {
    result.environment = env_map_from_grid(light.radiance, grid, options.map_width, options.map_width / 2);
  }
  const Eigen::MatrixX3f confidence = light.confidence.replicate(1, 3);
  result.confidence = env_map_from_grid(confidence, grid, options.map_width, options.map_width / 2);
  for (float& value : result.confidence.radiance().values()) value = std::min(1.0F, value);
  constexpr int kOrder = 4;
  const Eigen::MatrixX3d sh = sh::project(resize(result.environment, 128, 64), std::max(kOrder, options.sh_order));
  result.sh = sh.topRows(sh::coefficient_count(options.sh_order));
  result.sh4 = sh.topRows(sh::coefficient_count(kOrder));
  result.lights = lighting::main_lights(light.radiance, grid, options.main_lights, light.confidence);
  if (light.compact) lighting::set_true_size(*light.compact, result.lights);
  result.light = std::move(light);
  return result;
}

LightResult solved_light(lighting::Light light, const lighting::Observations& observations,
                         const EstimateOptions& options) {
  LightResult result = light_result(std::move(light), options);
  if (options.solve.solver == lighting::Solver::kTransport)
    lighting::rate_main_lights(observations, result.light, options.solve, result.lights);
  return result;
}

FaceEvidence evidence_of(const FaceEstimate& face) {
  return {face.observations, energy(face.light), face.enough_shown};
}

std::optional<Eigen::Vector3f> mean_skin_albedo(const FaceEstimate& face) {
  const ByteImage& region = face.geometry.region;
  if (!region.same_size(face.shading) || !region.same_size(face.layers.diffuse) || !region.same_size(face.clipped))
    return {};
  Eigen::Vector3d diffuse = Eigen::Vector3d::Zero();
  Eigen::Vector3d light = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < region.pixel_count(); ++i) {
    if (!is_probe_skin(static_cast<Region>(region.data()[i])) || face.clipped.data()[i] != 0) continue;
    diffuse += Eigen::Map<const Eigen::Vector3f>(face.layers.diffuse.data() + 3 * i).cast<double>();
    light += Eigen::Map<const Eigen::Vector3f>(face.shading.data() + 3 * i).cast<double>();
  }
  if (!(light.minCoeff() > 0)) return {};
  return diffuse.cwiseQuotient(light).cast<float>();
}

lighting::Observations joint_observations(const std::vector<FaceEvidence>& faces) {
  double log_mean = 0;
  int lit = 0;
  for (const FaceEvidence& face : faces) {
    if (!(face.energy > 0)) continue;
    log_mean += std::log(face.energy);
    ++lit;
  }
  const double wanted = lit > 0 ? std::exp(log_mean / lit) : 1.0;
  std::vector<lighting::Observations> sets;
  for (const FaceEvidence& face : faces) {
    if (!(face.energy > 0)) continue;
    // Every step-th patch, standing for its neighbours: memory stays that of one face.
    const auto step = static_cast<Eigen::Index>(lit);
    const Eigen::Index kept = (face.observations.count() + step - 1) / step;
    lighting::Observations set = thinned(face.observations, kept, step);
    const auto gain = static_cast<float>(wanted / face.energy);
    set.highlight *= gain;
    set.shading *= gain;
    sets.push_back(std::move(set));
  }
  return lighting::concatenate(sets);
}

}  // namespace faceprobe::pipeline
