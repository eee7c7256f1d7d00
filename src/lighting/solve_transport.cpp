#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"
#include "faceprobe/core/smooth_step.h"
#include "faceprobe/lighting/estimate.h"
#include "faceprobe/lighting/richardson_lucy.h"
#include "faceprobe/lighting/transport.h"
#include "lighting/compact_fit.h"
#include "lighting/residual.h"
#include "lighting/smooth_start.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

using Flags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

// The two kinds of rows, each weighed so that its data carry the influence the options give it.
struct Rows {
  Eigen::Ref<const RowMatrix> transport;  // highlight rows, then shading rows; a view of what build_transport() made
  Eigen::VectorXf weight;
  Eigen::MatrixX3f data;
  Flags bound;  // #rows x 3
  Eigen::Index highlights = 0;
};

float weighted_sum(const Eigen::VectorXf& weight, const Eigen::VectorXf& values) {
  return static_cast<float>(weight.cast<double>().dot(values.cast<double>()));
}

RichardsonLucyOptions rl_options(const SolveOptions& options, int iterations) {
  RichardsonLucyOptions rl;
  rl.iterations = iterations;
  rl.prior_weight = options.prior_weight;
  rl.threads = options.threads;
  return rl;
}

// Brings the highlights to the scale of the shading: h = gain * S e + leak * s, both fitted against the light that the shading
// alone gives. That light is blurred, which moves energy around but hardly changes its sum, so sums are what is compared.
void fit_highlights(const Observations& o, const Transport& transport, const SolveOptions& options,
                    const Eigen::MatrixXf& start, float level, Light& light, Eigen::MatrixX3f& highlight) {
  constexpr int kSmoothIterations = 10;
  const Eigen::VectorXf shading = o.shading * kLuminanceWeights;
  const Flags bound = o.clipped.rowwise().any();
  RichardsonLucyOptions plain = rl_options(options, kSmoothIterations);
  plain.prior_weight = 0;  // which keeps the flux, and that is all that counts here
  const RichardsonLucyResult smooth = richardson_lucy(transport.diffuse(), o.weight, shading, bound, start, plain);
  const Eigen::VectorXf expected = transport.highlight() * smooth.estimate.col(0);
  // Clipped pixels say neither how bright nor how leaky; with all clipped there is nothing to fit.
  Eigen::VectorXf weight = o.weight;
  std::vector<float> found_ratio;
  std::vector<float> expected_ratio;
  const float least_shading = 0.05F * level;
  const Eigen::VectorXf found = highlight * kLuminanceWeights;
  for (Eigen::Index i = 0; i < o.count(); ++i) {
    if (bound(i, 0)) weight[i] = 0;
    if (weight[i] <= 0 || shading[i] < least_shading) continue;
    found_ratio.push_back(found[i] / shading[i]);
    expected_ratio.push_back(expected[i] / shading[i]);
  }
  const float expected_sum = weighted_sum(weight, expected);
  if (!(weighted_sum(weight, found) > 0)) return;        // nothing mirrored, nothing to fit
  if (found_ratio.size() < 10 || !(expected_sum > 0)) {  // too few to fit anything
    if (options.fit_highlight_gain) return;
    light.highlight_gain = options.highlight_gain;
    highlight /= options.highlight_gain;
    return;
  }
  const auto limited = [](float gain) { return std::clamp(gain, 0.05F, 20.0F); };
  float gain = options.fit_highlight_gain ? limited(weighted_sum(weight, found) / expected_sum) : options.highlight_gain;
  // Where the face mirrors least, what is left above the expected mirror light is diffuse light.
  constexpr double kLeast = 0.1;
  float leak = 0;
  for (int round = 0; round < 3 && options.max_leak > 0; ++round) {
    leak = std::clamp(quantile_of(found_ratio, kLeast) - gain * quantile_of(expected_ratio, kLeast), 0.0F,
                      options.max_leak);
    const float left = weighted_sum(weight, (found - leak * shading).cwiseMax(0.0F));
    if (options.fit_highlight_gain) gain = limited(left / expected_sum);
  }
  light.highlight_gain = gain;
  light.leak = leak;
  highlight = (highlight - leak * o.shading).cwiseMax(0.0F) / gain;
}

Rows stack(const Observations& o, const Transport& transport, const SolveOptions& options) {
  const float highlight_flux = weighted_sum(o.weight, o.highlight * kLuminanceWeights);
  const float shading_flux = weighted_sum(o.weight, o.shading * kLuminanceWeights);
  const bool use_highlights = options.highlight_weight > 0 && highlight_flux > 0;
  const bool use_shading = shading_flux > 0 && (options.shading_weight > 0 || !use_highlights);
  const Eigen::Index n = o.count();
  const Eigen::Index total = (use_highlights ? n : 0) + (use_shading ? n : 0);
  Rows rows{transport.rows.middleRows(use_highlights ? 0 : n, total), Eigen::VectorXf(total),
            Eigen::MatrixX3f(total, 3), Flags(total, 3), use_highlights ? n : 0};
  if (use_highlights) {
    rows.weight.head(n) = o.weight * (options.highlight_weight / highlight_flux);
    rows.data.topRows(n) = o.highlight;
    rows.bound.topRows(n) = o.clipped;
  }
  if (use_shading) {
    rows.weight.tail(n) = o.weight * (std::max(options.shading_weight, 1e-3F) / shading_flux);
    rows.data.bottomRows(n) = o.shading;
    rows.bound.bottomRows(n) = o.clipped;
  }
  return rows;
}

// Colours the luminance solution: few multiplicative steps per channel from a map of one colour, so that colour varies over the
// sphere no faster than the data insist on. Separate deconvolutions of the channels would give coloured speckle.
// `colours`: #cells x 3 of luminance 1 to start from, or empty.
Eigen::MatrixX3f coloured(const Rows& rows, const Eigen::VectorXf& level, const Eigen::MatrixX3f& colours,
                          const SolveOptions& options) {
  const Eigen::RowVector3f flux = rows.weight.transpose() * rows.data;
  const float total = flux.dot(kLuminanceWeights.transpose());
  const Eigen::RowVector3f mean_colour = (flux / total).cwiseMax(1e-4F);
  Eigen::MatrixXf start = (level.cwiseMax(1e-12F)) * mean_colour;
  if (colours.rows() > 0) start = level.cwiseMax(1e-12F).asDiagonal() * colours;
  const RichardsonLucyResult solved = richardson_lucy(rows.transport, rows.weight, rows.data, rows.bound, start,
                                                      rl_options(options, options.colour_iterations));
  Eigen::MatrixX3f radiance = solved.estimate;
  for (Eigen::Index j = 0; j < radiance.rows(); ++j) {
    const float found = radiance.row(j).dot(kLuminanceWeights.transpose());
    if (found > 0) radiance.row(j) *= level[j] / found;
  }
  return radiance;
}

void set_ambient(Light& light) {
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<float> observed;
    for (Eigen::Index j = 0; j < light.confidence.size(); ++j) {
      if (light.confidence[j] > 0.5F) observed.push_back(light.radiance(j, channel));
    }
    light.ambient[channel] = quantile_of(std::move(observed), 0.5);
  }
}

// How well each cell is observed, and the median of those that are observed well. False when nothing is.
bool rate(const Eigen::VectorXf& sensitivity, Light& light) {
  // Relative to a typical observed cell: the largest sensitivities belong to grazing mirror angles and say little of the rest.
  const float least = 1e-3F * sensitivity.maxCoeff();
  if (!(least > 0)) return false;  // the face's own horizon blocks everything
  std::vector<float> reached;
  std::copy_if(sensitivity.begin(), sensitivity.end(), std::back_inserter(reached),
               [least](float s) { return s > least; });
  light.confidence = (sensitivity / (0.5F * quantile_of(std::move(reached), 0.5))).cwiseMin(1.0F);
  set_ambient(light);
  return true;
}

// Cells that hardly anything observes take the ambient level.
void fill_unobserved(Light& light) {
  for (Eigen::Index j = 0; j < light.confidence.size(); ++j) {
    const float trust = smooth_step(0.01F, 0.1F, light.confidence[j]);
    light.radiance.row(j) = trust * light.radiance.row(j) + (1.0F - trust) * light.ambient.transpose();
  }
}

// What is expected, in luminance, on the scale of the shading. Never black: Richardson-Lucy could not light a black cell again.
Eigen::VectorXf expected_start(const Eigen::MatrixX3f& expected, const Transport& transport, const Observations& o,
                               float level) {
  constexpr float kDarkest = 1e-3F;  // of the level
  const Eigen::VectorXf luminance = expected * kLuminanceWeights;
  const float predicted = weighted_sum(o.weight, transport.diffuse() * luminance);
  const float found = weighted_sum(o.weight, o.shading * kLuminanceWeights);
  return (luminance * (predicted > 0 ? found / predicted : 1.0F)).cwiseMax(kDarkest * level);
}

// `weight`: of the observations, not of the rows: what the solver does not trust is not explained either.
void rate_rows(const Rows& rows, const Eigen::VectorXf& weight, Light& light) {
  const Eigen::MatrixXf predicted = rows.transport * light.radiance;
  const auto of = [&](Eigen::Index first, Eigen::Index count) {
    return relative_residual(predicted.middleRows(first, count), rows.data.middleRows(first, count), weight.head(count),
                             rows.bound.middleRows(first, count));
  };
  light.highlight_residual = of(0, rows.highlights);
  light.shading_residual = of(rows.highlights, rows.data.rows() - rows.highlights);
}

Eigen::MatrixX3f colours_of(const Eigen::MatrixX3f& light) {
  constexpr float kDarkest = 1e-6F;
  Eigen::MatrixX3f colours = light.cwiseMax(kDarkest);
  const Eigen::VectorXf luminance = colours * kLuminanceWeights;
  for (Eigen::Index j = 0; j < colours.rows(); ++j) colours.row(j) /= luminance[j];
  return colours;
}

}  // namespace

Light solve_transport(const Observations& observations, const SolveOptions& options, const Eigen::MatrixX3f& expected) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const SphereGrid grid(options.nside);
  Light light;
  light.radiance.setZero(grid.cell_count(), 3);
  light.confidence.setZero(grid.cell_count());
  light.ambient.setZero();
  bool has_expected = expected.rows() > 0;
  if (has_expected && (expected.rows() != grid.cell_count() || !(expected.minCoeff() >= 0) || !expected.allFinite()))
    throw std::invalid_argument("The expected light must have one radiance per cell, not negative.");
  if (observations.count() == 0) return light;

  const bool open = options.use_open_shading && !options.compact_light && observations.open_shading.rows() > 0;
  const Transport transport = build_transport(observations, grid, options.threads, options.fresnel,
                                              open ? DiffuseRows::kOpenShading : DiffuseRows::kShading);
  Observations patches = observations;
  if (open) patches.shading = observations.open_shading;
  const float weight = patches.weight.sum();
  // Uniform radiance L gives a shading of at most L, so the mean shading is the right order of magnitude to start from.
  float level = weighted_sum(patches.weight, patches.shading * kLuminanceWeights) / weight;
  Eigen::MatrixXf start = Eigen::MatrixXf::Constant(grid.cell_count(), 1, level);
  if (level > 0) {
    const SmoothFit fit =
        fit_smooth_light(patches, patches.shading * kLuminanceWeights, patches.clipped.rowwise().any());
    // Never silenced: two lamps from opposite sides are misfit too, and they are data.
    patches.weight = patches.weight.cwiseProduct(fit.trust.cwiseMax(0.2F));
    start = has_expected ? expected_start(expected, transport, patches, level) : smooth_radiance(fit, grid, level);
    fit_highlights(patches, transport, options, start, level, light, patches.highlight);
  } else {
    const float per_unit = weighted_sum(patches.weight, transport.highlight().rowwise().sum());
    level = per_unit > 0 ? weighted_sum(patches.weight, patches.highlight * kLuminanceWeights) / per_unit : 0;
    start.setConstant(level);
    has_expected = false;  // without shading there is no scale to bring it to
  }
  if (!(level > 0)) return light;

  const Rows rows = stack(patches, transport, options);
  if (rows.transport.rows() == 0) return light;
  const Flags bound = rows.bound.rowwise().any();
  const int iterations =
      has_expected ? std::min(options.iterations, options.iterations_from_expected) : options.iterations;
  const RichardsonLucyResult solved = richardson_lucy(rows.transport, rows.weight, rows.data * kLuminanceWeights, bound,
                                                      start, rl_options(options, iterations));
  const Eigen::VectorXf found = solved.estimate.col(0);
  if (observations.grey) {
    light.radiance = found.replicate(1, 3);
  } else {
    light.radiance = coloured(rows, found, has_expected ? colours_of(expected) : Eigen::MatrixX3f(), options);
  }
  const bool rated = rate(solved.sensitivity, light);
  if (rated && !has_expected) fill_unobserved(light);
  if (rated && options.compact_light && rows.data.rows() > rows.highlights) {
    patches.weight = observations.weight;  // what the smooth fit trusts least are cast shadows, a small light's own
    if (const std::optional<CompactFit> fit =
            fit_compact_light(patches, transport, rows.highlights > 0, grid, light, options)) {
      light.radiance = fit->surround + compact_cells(fit->light, grid);
      light.compact = fit->light;
      set_ambient(light);
    }
  }
  rate_rows(rows, observations.weight, light);
  return light;
}

}  // namespace faceprobe::lighting
