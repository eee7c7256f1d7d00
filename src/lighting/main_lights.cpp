#include "faceprobe/lighting/main_lights.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/quantile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace faceprobe::lighting {

namespace {

Eigen::VectorXd luminance_of(const Eigen::MatrixX3f& radiance) { return (radiance * kLuminanceWeights).cast<double>(); }

// Gaussian on the sphere, cut at three sigma.
Eigen::VectorXd blurred(const Eigen::VectorXd& values, const SphereGrid& grid, double sigma_rad) {
  if (sigma_rad <= 0) return values;
  const double least_cosine = std::cos(std::min(kPi, 3.0 * sigma_rad));
  Eigen::VectorXd out(values.size());
  for (int i = 0; i < grid.cell_count(); ++i) {
    const Eigen::VectorXf cosines = grid.directions() * grid.direction(i);
    double sum = 0;
    double total = 0;
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (cosines[j] < least_cosine) continue;
      // 2 (1 - cos) is the squared chord, the squared angle for small ones.
      const double w = std::exp(-(1.0 - static_cast<double>(cosines[j])) / (sigma_rad * sigma_rad));
      sum += w * values[j];
      total += w;
    }
    out[i] = sum / total;
  }
  return out;
}

}  // namespace

std::string MainLightOptions::validate() const {
  if (max_lights < 0 || max_lights > 100) return "max_lights must be from 0 to 100.";
  if (!(separation_deg > 0 && separation_deg <= 180)) return "separation_deg must lie in (0, 180].";
  if (!(blur_deg >= 0 && blur_deg <= 60)) return "blur_deg must lie in [0, 60].";
  if (!(min_share >= 0 && min_share <= 1)) return "min_share must lie in [0, 1].";
  if (!(min_contrast >= 1 && min_contrast < 1e6)) return "min_contrast must be at least 1.";
  if (!(min_confidence >= 0 && min_confidence <= 1)) return "min_confidence must lie in [0, 1].";
  return {};
}

namespace {

// A light among its surroundings: the cells that are above them and nearer to this peak than to another.
struct FoundLight {
  MainLight light;
  std::vector<int> cells;
};

void check(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const MainLightOptions& options,
           const Eigen::VectorXf& confidence) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (radiance.rows() != grid.cell_count() || (confidence.size() > 0 && confidence.size() != radiance.rows()))
    throw std::invalid_argument("Main lights need one radiance, and one confidence or none, per cell.");
}

// Seen cells that nothing within the separation outshines, brightest first. What hardly anything observed is no light and outshines none, but
// its glow does not become one where it reaches into view: a cell beside a brighter hidden one lies on a slope.
std::vector<int> find_peaks(const Eigen::VectorXd& smooth, const std::vector<char>& seen, const SphereGrid& grid,
                            double least, float least_cosine) {
  const auto beside = static_cast<float>(std::cos(1.5 * std::sqrt(grid.cell_solid_angle())));
  std::vector<int> order(static_cast<std::size_t>(grid.cell_count()));
  for (int i = 0; i < grid.cell_count(); ++i) order[static_cast<std::size_t>(i)] = i;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return smooth[a] > smooth[b]; });
  std::vector<char> suppressed(order.size(), 0);
  std::vector<int> peaks;
  for (const int cell : order) {
    if (smooth[cell] < least) break;
    if (suppressed[static_cast<std::size_t>(cell)]) continue;
    const Eigen::VectorXf cosines = grid.directions() * grid.direction(cell);
    const bool hidden = seen[static_cast<std::size_t>(cell)] == 0;
    bool local_maximum = !hidden;
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (cosines[j] < (hidden ? beside : least_cosine)) continue;
      // A cell on the slope of an earlier, suppressed peak is not a light of its own.
      if (suppressed[static_cast<std::size_t>(j)] && smooth[j] > smooth[cell]) local_maximum = false;
      suppressed[static_cast<std::size_t>(j)] = 1;
    }
    if (local_maximum) peaks.push_back(cell);
  }
  return peaks;
}

FoundLight gather(int peak, const std::vector<int>& peaks, const Eigen::MatrixX3f& radiance,
                  const Eigen::VectorXd& level, const std::vector<char>& seen, double ambient, const SphereGrid& grid,
                  float least_cosine) {
  FoundLight found;
  MainLight& light = found.light;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  for (int j = 0; j < grid.cell_count(); ++j) {
    const Eigen::Vector3f d = grid.direction(j);
    const float to_peak = d.dot(grid.direction(peak));
    if (to_peak < least_cosine || level[j] <= ambient || seen[static_cast<std::size_t>(j)] == 0) continue;
    // Between two equally near the one with the smaller number has it.
    const bool nearest = std::all_of(peaks.begin(), peaks.end(), [&](int other) {
      const float to_other = d.dot(grid.direction(other));
      return to_other < to_peak || (to_other == to_peak && other >= peak);
    });
    if (!nearest) continue;
    found.cells.push_back(j);
    const double above = (level[j] - ambient) * grid.cell_solid_angle();
    // Squared weights keep the direction with the peak when the neighbourhood holds a broad, lopsided glow.
    centroid += above * level[j] * d.cast<double>();
    colour += above * radiance.row(j).transpose().cast<double>() / level[j];
    light.irradiance += above;
    light.peak_radiance = std::max(light.peak_radiance, level[j]);
  }
  if (!(light.irradiance > 0)) return found;
  light.direction = centroid.normalized();
  light.colour = colour / luminance(colour.data());
  light.solid_angle_sr = light.irradiance / (light.peak_radiance - ambient);
  return found;
}

struct FoundLights {
  std::vector<FoundLight> lights;  // by falling irradiance
  double ambient = 0;
};

FoundLights find_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const MainLightOptions& options,
                        const Eigen::VectorXf& confidence) {
  const Eigen::VectorXd level = luminance_of(radiance);
  const double energy = level.sum() * grid.cell_solid_angle();
  if (!(energy > 0)) return {};
  FoundLights found;
  found.ambient = upper_median_of(std::vector<double>(level.begin(), level.end()));
  const Eigen::VectorXd smooth = blurred(level, grid, radians(options.blur_deg));
  std::vector<char> seen(static_cast<std::size_t>(grid.cell_count()), 1);
  for (Eigen::Index j = 0; j < confidence.size(); ++j)
    seen[static_cast<std::size_t>(j)] = confidence[j] >= static_cast<float>(options.min_confidence) ? 1 : 0;
  const auto least_cosine = static_cast<float>(std::cos(radians(options.separation_deg)));
  const std::vector<int> peaks = find_peaks(smooth, seen, grid, options.min_contrast * found.ambient, least_cosine);
  for (const int peak : peaks) {
    FoundLight light = gather(peak, peaks, radiance, level, seen, found.ambient, grid, least_cosine);
    light.light.share = light.light.irradiance / energy;
    if (light.light.irradiance > 0 && light.light.share >= options.min_share) found.lights.push_back(std::move(light));
  }
  std::stable_sort(found.lights.begin(), found.lights.end(),
                   [](const FoundLight& a, const FoundLight& b) { return a.light.irradiance > b.light.irradiance; });
  if (found.lights.size() > static_cast<std::size_t>(options.max_lights))
    found.lights.resize(static_cast<std::size_t>(options.max_lights));
  return found;
}

}  // namespace

std::vector<MainLight> main_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid,
                                   const MainLightOptions& options, const Eigen::VectorXf& confidence) {
  check(radiance, grid, options, confidence);
  std::vector<MainLight> lights;
  for (FoundLight& found : find_lights(radiance, grid, options, confidence).lights) lights.push_back(found.light);
  return lights;
}

double light_to_ambient_ratio(const std::vector<MainLight>& lights) {
  double share = 0;
  for (const MainLight& light : lights) share += light.share;
  if (!(share > 0)) return 0;
  return share < 1 ? share / (1 - share) : std::numeric_limits<double>::infinity();
}

bool is_even(const Eigen::VectorXd& luminance) {
  return luminance.size() == 0 || luminance.maxCoeff() - luminance.minCoeff() <= 1e-4 * luminance.maxCoeff();
}

Eigen::MatrixX3f without_main_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, int count,
                                     const MainLightOptions& options, const Eigen::VectorXf& confidence) {
  check(radiance, grid, options, confidence);
  const FoundLights found = find_lights(radiance, grid, options, confidence);
  Eigen::MatrixX3f rest = radiance;
  const Eigen::VectorXd level = luminance_of(radiance);
  for (std::size_t i = 0; i < found.lights.size() && i < static_cast<std::size_t>(std::max(0, count)); ++i) {
    for (const int cell : found.lights[i].cells) rest.row(cell) *= static_cast<float>(found.ambient / level[cell]);
  }
  return rest;
}

}  // namespace faceprobe::lighting
