#include "faceprobe/eval/sun_metrics.h"

#include "eval/markdown.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr double kNoAngle = std::numeric_limits<double>::quiet_NaN();
constexpr double kFarthestDeg = 180;
// Nearer to the vertical than this an azimuth says nothing.
constexpr double kNoAzimuthDeg = 5;
// Directions that cancel out like this have no middle.
constexpr double kLeastConcentration = 0.01;

struct Patch {
  Eigen::Vector3d direction;
  double luminance = 0;
  double solid_angle_sr = 0;
};

// `patches` by falling luminance. The luminance that the bright area has to exceed.
double border(const std::vector<Patch>& patches, double area_sr) {
  double above = 0;
  double level = patches.back().luminance;
  for (const Patch& patch : patches) {
    level = patch.luminance;
    if (above + 1e-9 >= area_sr) break;
    above += patch.solid_angle_sr;
  }
  if (level < patches.front().luminance) return level;
  // As much as that is equally bright and nothing is brighter: all of it is the area.
  const auto next =
      std::find_if(patches.begin(), patches.end(), [level](const Patch& patch) { return patch.luminance < level; });
  return next == patches.end() ? level : next->luminance;
}

std::optional<Sun> find_sun(std::vector<Patch> patches, const SunOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  double energy = 0;
  double sphere = 0;
  for (const Patch& patch : patches) {
    if (!std::isfinite(patch.luminance)) throw std::invalid_argument("The sun of a map needs values that are numbers.");
    energy += patch.luminance * patch.solid_angle_sr;
    sphere += patch.solid_angle_sr;
  }
  if (patches.empty() || !(energy > 0)) return std::nullopt;
  std::stable_sort(patches.begin(), patches.end(),
                   [](const Patch& a, const Patch& b) { return a.luminance > b.luminance; });
  if (patches.front().luminance < options.least_contrast * energy / sphere) return std::nullopt;
  const double level = border(patches, options.share * sphere);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  Sun sun;
  for (const Patch& patch : patches) {
    if (!(patch.luminance > level)) break;
    const double weight = patch.luminance * patch.solid_angle_sr;
    sum += weight * patch.direction;
    total += weight;
    sun.solid_angle_sr += patch.solid_angle_sr;
  }
  if (!(total > 0)) return std::nullopt;
  sun.concentration = sum.norm() / total;
  if (sun.concentration < kLeastConcentration) return std::nullopt;
  sun.direction = sum.normalized();
  return sun;
}

double share_within(std::span<const double> sorted, double angle) {
  const auto after = std::upper_bound(sorted.begin(), sorted.end(), angle);
  return static_cast<double>(after - sorted.begin()) / static_cast<double>(sorted.size());
}

}  // namespace

std::string SunOptions::validate() const {
  if (!(share > 0 && share < 1)) return "share must lie in (0, 1).";
  if (!(least_contrast > 1 && least_contrast < 1e6)) return "least_contrast must be above 1.";
  return {};
}

std::optional<Sun> sun_of(const EnvMap& map, const SunOptions& options) {
  std::vector<Patch> patches;
  for (int y = 0; y < map.height(); ++y) {
    const double solid_angle = texel_solid_angle(y, map.width(), map.height());
    for (int x = 0; x < map.width(); ++x) {
      const float* p = map.radiance().pixel(x, y);
      patches.push_back({map.direction(x, y).cast<double>(), static_cast<double>(luminance(p)), solid_angle});
    }
  }
  return find_sun(std::move(patches), options);
}

std::optional<Sun> sun_of(const Eigen::MatrixX3f& radiance, const SphereGrid& grid, const SunOptions& options) {
  if (radiance.rows() != grid.cell_count())
    throw std::invalid_argument("The sun of a light needs one radiance per cell.");
  std::vector<Patch> patches;
  patches.reserve(static_cast<std::size_t>(grid.cell_count()));
  for (int j = 0; j < grid.cell_count(); ++j) {
    patches.push_back({grid.direction(j).cast<double>(),
                       static_cast<double>(luminance(radiance(j, 0), radiance(j, 1), radiance(j, 2))),
                       grid.cell_solid_angle()});
  }
  return find_sun(std::move(patches), options);
}

SunError sun_error(const Sun& truth, const std::optional<Sun>& estimate) {
  if (!estimate) return {kNoAngle, kNoAngle, kNoAngle};
  const double right = elevation_deg(truth.direction);
  const double turn = std::abs(azimuth_deg(truth.direction) - azimuth_deg(estimate->direction));
  return {angle_between_deg(truth.direction, estimate->direction),
          std::abs(right) > 90 - kNoAzimuthDeg ? kNoAngle : std::min(turn, 360 - turn),
          std::abs(right - elevation_deg(estimate->direction))};
}

SunCurve sun_curve(std::span<const double> errors_deg, const Bootstrap& bootstrap, std::span<const std::string> persons) {
  SunCurve curve;
  curve.count = errors_deg.size();
  std::vector<double> errors;
  for (const double error : errors_deg) {
    if (!std::isfinite(error)) ++curve.missing;
    errors.push_back(std::isfinite(error) ? error : kFarthestDeg);
  }
  const std::vector<std::string> nobody(persons.empty() ? errors.size() : 0);
  const ValuesByPerson people = values_by_person(errors, persons.empty() ? nobody : persons);
  std::vector<double> sorted = std::move(errors);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < curve.within.size(); ++i)
    curve.within[i] = sorted.empty() ? kNoAngle : share_within(sorted, SunCurve::kAnglesDeg[i]);
  curve.mark_deg = quantile_of_sorted(sorted, SunCurve::kMark);
  const auto [low, high] = cluster_interval(people, bootstrap, [](std::span<double> drawn) {
    std::sort(drawn.begin(), drawn.end());
    return quantile_of_sorted(drawn, SunCurve::kMark);
  });
  curve.mark_low_deg = low;
  curve.mark_high_deg = high;
  return curve;
}

std::string sun_markdown(const ScoreTable& table, const std::string& group, const std::string& label) {
  std::string lines;
  for (const std::string& method : table.methods()) {
    const Selection rows{method, group, label};
    const std::vector<double> errors = table.known_values("sun_centroid", rows);
    if (errors.empty()) continue;
    const SunCurve curve = sun_curve(errors, {}, table.known_persons("sun_centroid", rows));
    const auto median = [&](const std::string& metric) {
      std::vector<double> values = table.known_values(metric, rows);
      std::erase_if(values, [](double value) { return !std::isfinite(value); });
      std::sort(values.begin(), values.end());
      return rounded(quantile_of_sorted(values, 0.5), 1);
    };
    lines += "| " + markdown_cell(method) + " | " + counted(curve.count, curve.missing) + " |";
    for (const double share : curve.within) lines += ' ' + rounded(100 * share, 0) + " % |";
    lines += ' ' + rounded(curve.mark_deg, 1) + " [" + rounded(curve.mark_low_deg, 1) + ", " +
             rounded(curve.mark_high_deg, 1) + "] | " + median("sun_azimuth") + " | " + median("sun_elevation") + " |\n";
  }
  if (lines.empty()) return {};
  std::vector<std::string> titles = {"sun_centroid", "n"};
  for (const int angle : SunCurve::kAnglesDeg) titles.push_back("<= " + std::to_string(angle));
  titles.insert(titles.end(), {"75 % mark [95 %]", "azimuth, median", "elevation, median"});
  return markdown_head(titles) + lines;
}

}  // namespace faceprobe::eval
