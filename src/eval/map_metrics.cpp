#include "eval/map_metrics.h"

#include "eval/nan.h"
#include "faceprobe/eval/light_metrics.h"

#include <utility>

namespace faceprobe::eval {

bool says_light(const Eigen::MatrixX3f& found, const SphereGrid& grid) {
  return found.rows() == grid.cell_count() && found.allFinite() && found.maxCoeff() > 0;
}

std::map<std::string, double> map_metrics(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& found,
                                          const LitObject& object, const SphereGrid& grid, bool one_lamp) {
  using render::SphereMaterial;
  const bool there = says_light(found, grid);
  std::map<std::string, double> metrics;
  const RelightError error = there ? relight_error(object, truth, found) : RelightError{kNaN, kNaN};
  metrics["diffuse"] = error.diffuse;
  metrics["glossy"] = error.glossy;
  constexpr std::pair<const char*, SphereMaterial> kSpheres[] = {
      {"diffuse", SphereMaterial::kDiffuse}, {"matte", SphereMaterial::kMatte}, {"mirror", SphereMaterial::kMirror}};
  for (const auto& [name, material] : kSpheres) {
    const SphereError sphere = there ? sphere_error(truth, found, grid, material) : SphereError{kNaN, kNaN, kNaN};
    metrics[std::string("si_") + name] = sphere.si_rmse;
    metrics[std::string("angle_") + name] = sphere.angular_deg;
    metrics[std::string("nrmse_") + name] = sphere.nrmse;
  }
  const MapError map = there ? map_error(truth, found) : MapError{kNaN, kNaN};
  metrics["nrmse_map"] = map.over_estimate_range;
  metrics["nrmse_map_truth"] = map.over_truth_range;
  metrics["colour"] = there ? light_colour_error_deg(truth, found) : kNaN;
  if (one_lamp) metrics["main_light"] = there ? main_light_error_deg(truth, found, grid) : kNaN;
  return metrics;
}

}  // namespace faceprobe::eval
