#include "lighting/region_luminance.h"

#include "lighting/smooth_start.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::lighting {
namespace {

struct Prior {
  double median;     // luminance over the cheeks'
  double deviation;  // standard deviation of its logarithm from person to person
};

// ESTIMATES, as the header says. In the order of Region. Lips and brows vary most, and their pixels are never used to find the light.
constexpr std::array<Prior, kSkinRegionCount> kPriors = {{{1.01, 0.07},
                                                          {0.95, 0.06},
                                                          {1.00, 0.00},
                                                          {0.90, 0.17},
                                                          {0.88, 0.27},
                                                          {0.95, 0.14},
                                                          {0.97, 0.15},
                                                          {0.82, 0.16},
                                                          {0.70, 0.23},
                                                          {1.01, 0.05}}};
constexpr double kModelDeviation = 0.05;  // ESTIMATE: how far a lamp and a surround are off in the mean of a region
constexpr int kTurns = 15;                // of light and regions; the regions move by less than a hundredth after ten
constexpr int kLeastSamples = 20;         // of a region, to say anything
constexpr float kLeastLit = 0.15F;        // of the mean luminance: below, shadows that the model does not know
constexpr float kLeastFacing = 0.3F;      // N.z below which a small error of the mesh puts a pixel off the face

std::size_t index_of(Region region) { return static_cast<std::size_t>(region) - 1; }

Observations observations_of(const RegionSamples& samples) {
  Observations o;
  o.resize(samples.normal.rows());
  o.normal = samples.normal;
  for (Eigen::Index i = 0; i < o.count(); ++i) {
    const bool probe = is_probe_skin(samples.region[static_cast<std::size_t>(i)]);
    o.weight[i] = probe && samples.normal(i, 2) > kLeastFacing ? 1.0F : 0.0F;
  }
  return o;
}

// Weighted mean over the region's lit samples of the logarithm of luminance over the light's prediction, and whether there are enough.
struct Offset {
  double sum = 0;
  double weight = 0;
  int samples = 0;
};

}  // namespace

RelativeLuminance usual_relative_luminance() {
  RelativeLuminance relative{};
  for (std::size_t r = 0; r < relative.size(); ++r) relative[r] = static_cast<float>(kPriors[r].median);
  return relative;
}

RelativeLuminance fit_relative_luminance(const RegionSamples& samples) {
  RelativeLuminance relative = usual_relative_luminance();
  const Observations o = observations_of(samples);
  if (o.count() == 0 || !(o.weight.sum() > 0) || !(samples.luminance.dot(o.weight) > 0)) return relative;
  const Eigen::Array<bool, Eigen::Dynamic, 1> unused = o.weight.array() == 0;  // nor for the scale of residuals
  for (int round = 0; round < kTurns; ++round) {
    Eigen::VectorXf shading(o.count());
    for (Eigen::Index i = 0; i < o.count(); ++i)
      shading[i] = samples.luminance[i] / relative[index_of(samples.region[static_cast<std::size_t>(i)])];
    const SmoothFit fit = fit_smooth_light(o, shading, unused);
    const float least = kLeastLit * shading.dot(o.weight) / o.weight.sum();
    std::array<Offset, kSkinRegionCount> offsets;
    for (Eigen::Index i = 0; i < o.count(); ++i) {
      const float lit = fit.ambient + std::max(0.0F, o.normal.row(i).dot(fit.lamp.transpose()));
      if (!(lit > least && shading[i] > 0.1F * least)) continue;
      Offset& offset = offsets[index_of(samples.region[static_cast<std::size_t>(i)])];
      const double trust = std::max(1e-6, static_cast<double>(fit.trust[i]));
      offset.sum += trust * std::log(static_cast<double>(samples.luminance[i]) / static_cast<double>(lit));
      offset.weight += trust;
      ++offset.samples;
    }
    for (std::size_t r = 0; r < offsets.size(); ++r) {
      if (offsets[r].samples < kLeastSamples || !(kPriors[r].deviation > 0)) continue;
      const double seen = 1 / (kModelDeviation * kModelDeviation);
      const double usual = 1 / (kPriors[r].deviation * kPriors[r].deviation);
      relative[r] = static_cast<float>(
          std::exp((seen * offsets[r].sum / offsets[r].weight + usual * std::log(kPriors[r].median)) / (seen + usual)));
    }
  }
  return relative;
}

}  // namespace faceprobe::lighting
