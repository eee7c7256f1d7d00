#include "pipeline/light_result.h"

#include "faceprobe/core/sh.h"

#include <cmath>

namespace faceprobe::pipeline {

namespace {

double energy(const lighting::Light& light) {
  return (light.radiance * Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F)).cast<double>().sum();
}

}  // namespace

LightResult light_result(lighting::Light light, const EstimateOptions& options) {
  const SphereGrid grid(options.solve.nside);
  LightResult result;
  result.environment = env_map_from_grid(light.radiance, grid, options.map_width, options.map_width / 2);
  const Eigen::MatrixX3f confidence = light.confidence.replicate(1, 3);
  result.confidence = env_map_from_grid(confidence, grid, options.map_width, options.map_width / 2);
  for (float& value : result.confidence.radiance().values()) value = std::min(1.0F, value);
  result.sh = sh::project(resize(result.environment, 128, 64), options.sh_order);
  result.lights = lighting::main_lights(light.radiance, grid, options.main_lights, light.confidence);
  result.light = std::move(light);
  return result;
}

lighting::Light joint_light(const std::vector<FaceEstimate>& faces, const lighting::SolveOptions& options) {
  double log_mean = 0;
  int lit = 0;
  for (const FaceEstimate& face : faces) {
    const double own = energy(face.light);
    if (own > 0) {
      log_mean += std::log(own);
      ++lit;
    }
  }
  const double wanted = lit > 0 ? std::exp(log_mean / lit) : 1.0;
  std::vector<lighting::Observations> sets;
  for (const FaceEstimate& face : faces) {
    const double own = energy(face.light);
    if (!(own > 0)) continue;
    lighting::Observations set = face.observations;
    const auto gain = static_cast<float>(wanted / own);
    set.highlight *= gain;
    set.shading *= gain;
    sets.push_back(std::move(set));
  }
  return lighting::solve(lighting::concatenate(sets), options);
}

}  // namespace faceprobe::pipeline
