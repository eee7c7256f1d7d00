#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/lighting/estimate.h"
#include "faceprobe/lighting/recolour.h"
#include "faceprobe/lighting/richardson_lucy.h"
#include "faceprobe/lighting/trace.h"
#include "lighting/residual.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

// Eq. 5: K_x(y) = k_s (L_y . L_x)^alpha, one row per observed direction x, times the cell's solid angle, so that rows predict the traced value.
// Here k_s is a share of the light, rho_s over the lobe's integral, which Eq. 5 leaves out: else wider lobes of rough regions would count as
// brighter skin.
RowMatrix phong_kernel(const TracedMap& traced, const SphereGrid& grid, int threads) {
  RowMatrix kernel = RowMatrix::Zero(grid.cell_count(), grid.cell_count());
  const auto solid_angle = static_cast<float>(grid.cell_solid_angle());
  parallel_for(grid.cell_count(), threads, [&](int first, int last) {
    for (int x = first; x < last; ++x) {
      if (traced.weight[x] <= 0.0F) continue;
      const float alpha = phong_exponent(traced.roughness[x]);
      const float peak = traced.specular_albedo[x] * (alpha + 1) / static_cast<float>(2 * kPi) * solid_angle;
      const Eigen::RowVector3f centre = grid.directions().row(x);
      for (int y = 0; y < grid.cell_count(); ++y) {
        const float cosine = grid.directions().row(y).dot(centre);
        if (cosine > 0.0F) kernel(x, y) = peak * std::pow(cosine, alpha);
      }
    }
  });
  return kernel;
}

// The paper's map has no scale. Of one gain for all channels, the one whose light gives the face as much shading as it has; 1 without shading.
void bring_to_shading(const Observations& observations, const SphereGrid& grid, int threads, Light& light) {
  Eigen::MatrixXf predicted = build_transport(observations, grid, threads).diffuse() * light.radiance;
  const float sum = (observations.weight.transpose() * predicted).sum();
  const float found = (observations.weight.transpose() * observations.shading).sum();
  const float gain = sum > 0 && found > 0 ? found / sum : 1.0F;
  light.radiance *= gain;
  predicted *= gain;
  light.shading_residual = relative_residual(predicted, observations.shading, observations.weight, observations.clipped);
}

// Median of the cells that a highlight saw; black where none did.
Eigen::Vector3f ambient_of(const Light& light) {
  Eigen::Vector3f ambient;
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> seen;
    for (Eigen::Index j = 0; j < light.confidence.size(); ++j) {
      if (light.confidence[j] > 0.5F) seen.push_back(light.radiance(j, channel));
    }
    ambient[channel] = upper_median_of(std::move(seen));
  }
  return ambient;
}

}  // namespace

Light solve_paper(const Observations& observations, const SolveOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const SphereGrid grid(options.nside);
  // Recolouring comes before tracing (section 4.3, last paragraph).
  const TracedMap traced = trace_highlights(observations, recolour_highlights(observations), grid);
  Light light;
  light.radiance.setZero(grid.cell_count(), 3);
  light.confidence.setZero(grid.cell_count());
  light.ambient.setZero();
  const float observed = traced.weight.sum();
  if (observed <= 0.0F || !(traced.value.maxCoeff() > 0.0F)) return light;

  const RowMatrix kernel = phong_kernel(traced, grid, options.threads);
  // A uniform start at the level that explains the mean of what was traced.
  const Eigen::VectorXf row_sums = kernel.rowwise().sum();
  const float mean_row = row_sums.dot(traced.weight) / observed;
  Eigen::RowVector3f mean = (traced.weight.transpose() * traced.value) / observed;
  mean = mean.cwiseMax(1e-4F * mean.maxCoeff());
  Eigen::MatrixXf start(grid.cell_count(), 3);
  start.rowwise() = mean / mean_row;
  RichardsonLucyOptions rl;
  rl.iterations = options.iterations;
  rl.threads = options.threads;
  const RichardsonLucyResult solved = richardson_lucy(kernel, traced.weight, traced.value, {}, start, rl);
  light.radiance = solved.estimate;
  light.confidence = solved.sensitivity / std::max(1e-20F, solved.sensitivity.maxCoeff());
  // The paper has no prior: what no highlight saw is black, not the start value.
  const float least = rl.unobserved_share * solved.sensitivity.maxCoeff();
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    if (solved.sensitivity[cell] <= least) light.radiance.row(cell).setZero();
  }
  if (observations.grey) {
    const Eigen::VectorXf luminance = light.radiance * kLuminanceWeights;
    light.radiance = luminance.replicate(1, 3);
  }
  light.highlight_residual = relative_residual(kernel * light.radiance, traced.value, traced.weight);
  bring_to_shading(observations, grid, options.threads, light);
  light.ambient = ambient_of(light);
  return light;
}

}  // namespace faceprobe::lighting
