#include "faceprobe/lighting/main_lights.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace faceprobe::lighting {

namespace {

Eigen::VectorXd luminance_of(const Eigen::MatrixX3f& radiance) {
  return (radiance * Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F)).cast<double>();
}

double median_of(const Eigen::VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

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

std::vector<MainLight> main_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid,
                                   const MainLightOptions& options, const Eigen::VectorXf& confidence) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (radiance.rows() != grid.cell_count() || (confidence.size() > 0 && confidence.size() != radiance.rows()))
    throw std::invalid_argument("Main lights need one radiance, and one confidence or none, per cell.");
  const Eigen::VectorXd level = luminance_of(radiance);
  const double energy = level.sum() * grid.cell_solid_angle();
  if (!(energy > 0)) return {};
  const double ambient = median_of(level);
  Eigen::VectorXd smooth = blurred(level, grid, radians(options.blur_deg));
  // What hardly anything observed is neither a light nor outshines one.
  for (Eigen::Index j = 0; j < confidence.size(); ++j) {
    if (confidence[j] < static_cast<float>(options.min_confidence)) smooth[j] = 0;
  }

  // Peaks: cells that nothing within the separation outshines, brightest first.
  std::vector<int> order(static_cast<std::size_t>(grid.cell_count()));
  for (int i = 0; i < grid.cell_count(); ++i) order[static_cast<std::size_t>(i)] = i;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return smooth[a] > smooth[b]; });
  const auto least_cosine = static_cast<float>(std::cos(radians(options.separation_deg)));
  std::vector<char> suppressed(order.size(), 0);
  std::vector<int> peaks;
  for (const int cell : order) {
    if (smooth[cell] < options.min_contrast * ambient) break;
    if (suppressed[static_cast<std::size_t>(cell)]) continue;
    const Eigen::VectorXf cosines = grid.directions() * grid.direction(cell);
    bool local_maximum = true;
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (cosines[j] < least_cosine) continue;
      // A cell on the slope of an earlier, suppressed peak is not a light of its own.
      if (suppressed[static_cast<std::size_t>(j)] && smooth[j] > smooth[cell]) local_maximum = false;
      suppressed[static_cast<std::size_t>(j)] = 1;
    }
    if (local_maximum) peaks.push_back(cell);
  }

  std::vector<MainLight> lights;
  for (const int peak : peaks) {
    MainLight light;
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
    Eigen::Vector3d colour = Eigen::Vector3d::Zero();
    double peak_radiance = 0;
    for (int j = 0; j < grid.cell_count(); ++j) {
      const Eigen::Vector3f d = grid.direction(j);
      const float to_peak = d.dot(grid.direction(peak));
      if (to_peak < least_cosine || level[j] <= ambient) continue;
      const bool nearest =
          std::all_of(peaks.begin(), peaks.end(), [&](int other) { return d.dot(grid.direction(other)) <= to_peak; });
      if (!nearest) continue;
      const double above = (level[j] - ambient) * grid.cell_solid_angle();
      // Squared weights keep the direction with the peak when the neighbourhood holds a broad, lopsided glow.
      centroid += above * level[j] * d.cast<double>();
      colour += above * radiance.row(j).transpose().cast<double>() / level[j];
      light.irradiance += above;
      peak_radiance = std::max(peak_radiance, level[j]);
    }
    if (!(light.irradiance > 0)) continue;
    light.direction = centroid.normalized();
    light.colour = colour / (0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]);
    light.peak_radiance = peak_radiance;
    light.solid_angle_sr = light.irradiance / (peak_radiance - ambient);
    light.share = light.irradiance / energy;
    if (light.share >= options.min_share) lights.push_back(light);
  }
  std::stable_sort(lights.begin(), lights.end(),
                   [](const MainLight& a, const MainLight& b) { return a.irradiance > b.irradiance; });
  if (lights.size() > static_cast<std::size_t>(options.max_lights))
    lights.resize(static_cast<std::size_t>(options.max_lights));
  return lights;
}

}  // namespace faceprobe::lighting
