#pragma once
// From observations to the light: the two solvers.
//
// `transport` (default) inverts the pixels' own transport matrix: microfacet rows for the highlights and cosine rows for the
// shading, weighed against each other, clipped pixels as lower bounds. `paper` is the scheme of Yi et al. 2018 as its text has
// it (section 4): recolour the highlights, trace them to the sphere by inverse warping, deconvolve on the sphere with
// the Phong kernel of each face region. It is kept so that the difference can be measured.
//
//   lighting::SolveOptions options;
//   lighting::Light light = lighting::solve(observations, options);
//   EnvMap map = env_map_from_grid(light.radiance, SphereGrid(options.nside), 256, 128);
//
// What to expect: skin at m = .3 is a probe of spherical-harmonic order 5. Sharper detail comes from positivity alone, and what
// lies behind the head comes from the prior; `confidence` says which is which.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/compact_light.h"
#include "faceprobe/lighting/observations.h"
#include "faceprobe/lighting/transport.h"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

namespace faceprobe::lighting {

enum class Solver { kTransport, kPaper };
std::string_view solver_name(Solver solver);  // "transport", "paper"
// Throws Error(kUsage) listing the names there are.
Solver solver_from_name(std::string_view name);

struct SolveOptions {
  Solver solver = Solver::kTransport;
  int nside = 16;       // of the sphere grid the light is solved on: 3072 cells
  int iterations = 50;  // Richardson-Lucy; 20 - 50 is the knee for noisy data
  // The transport solver's where a light is expected, if fewer than `iterations`: what it begins with is near the answer then, and layers of a photo
  // are less to be trusted than that in what many steps would still find in them (the ablations of `eval paper`).
  int iterations_from_expected = 3;
  // Transport solver only. Influence of all highlight rows and of all shading rows on the estimate; 0 leaves a kind out. The
  // defaults suit layers from the classical separators, whose highlights are rough (`eval direction`); with exact layers the
  // highlights deserve more than the shading (bench_best_case).
  float highlight_weight = 0.3F;
  float shading_weight = 1.0F;  // 0 or more
  // Fit one gain between highlights and shading (specular albedo and skin albedo are known only up to a factor each).
  bool fit_highlight_gain = true;
  float highlight_gain = 1;  // where it is not fitted: what the highlights are divided by
  // Diffuse light that a separator left in the highlights, per unit of shading; fitted, never more than this. 0 = none.
  float max_leak = 0.2F;
  // Pull of weakly observed cells towards the smooth light that the shading alone gives, see RichardsonLucyOptions: they stay near
  // it instead of soaking up the errors of the few grazing patches that see them.
  float prior_weight = 0.1F;
  Fresnel fresnel = Fresnel::kSchlick;  // of the highlights
  // Transport solver only. The shading rows are those of the open shading where the observations have one: what hair and shoulders keep from a face
  // and what they send back, no horizon of the face itself can tell. Not with a compact light, which shows by the shadows.
  bool use_open_shading = true;
  // Steps of the per-channel stage that colours the luminance solution; few keep the colour smooth over the sphere.
  int colour_iterations = 6;
  // Transport solver only, with shading rows. Whether the dominant light is tried as a small disc in place of the glow that it was found as, and
  // kept so where the pixels are explained better by far: see lighting/compact_light.h. Off until it is measured.
  bool compact_light = false;
  int threads = 0;

  std::string validate() const;
};

struct Light {
  Eigen::MatrixX3f radiance;   // #cells x 3, linear Rec.709, relative to the photo's white and the assumed skin albedo
  Eigen::VectorXf confidence;  // #cells, 0 = from the prior, 1 = well observed
  Eigen::Vector3f ambient;   // median of well observed cells; what unobserved ones are given where no light is expected
  float highlight_gain = 1;  // what the highlights were divided by to agree with the shading
  float leak = 0;            // diffuse light found in the highlights, per unit of shading, and taken out
  // The dominant light where SolveOptions::compact_light found it to be small. `radiance` has it, over the cells around it.
  std::optional<CompactLight> compact;
  // What this light leaves unexplained of the rows that it was found from: with p a row's prediction from `radiance`, d what was observed and w the
  // observation's weight, sqrt(sum w (p - d)^2 / sum w d^2) over rows and channels; clipped channels count where p is below d. 0 explains all, 1 no
  // more than darkness does. Highlight rows: d after gain and leak are taken out; the paper's solver: its traced map. Shading rows: the paper's
  // solver does not fit them but for their scale. Unset where rows of that kind were not used or hold no light.
  std::optional<double> highlight_residual;
  std::optional<double> shading_residual;
};

// Throws std::invalid_argument for observations or options that do not validate. No highlights at all is not an error: the
// shading alone answers then (by the paper's solver, which reads no shading, nothing does), and without either the light is black with confidence 0.
// Of grey observations the light is grey, whatever colours `expected` has.
// `expected`: #cells x 3, >= 0, the light to expect before the pixels are asked, at any scale (net/light_prior.h); empty = one lamp and an even
// surround that fit the shading. The transport solver starts from it and leaves it where nothing is observed; the paper's does not know it, and
// without any shading nobody does, because its scale is the shading's.
Light solve(const Observations& observations, const SolveOptions& options, const Eigen::MatrixX3f& expected = {});

// The two solvers by themselves; `solve` picks one by options.solver.
Light solve_transport(const Observations& observations, const SolveOptions& options,
                      const Eigen::MatrixX3f& expected = {});
Light solve_paper(const Observations& observations, const SolveOptions& options);

}  // namespace faceprobe::lighting
