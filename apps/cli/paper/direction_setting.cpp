#include "paper/direction_setting.h"

namespace faceprobe::cli {

DirectionSetting direction_setting(lighting::Solver solver, const std::optional<highlight::Separator>& classical,
                                   const pipeline::EstimateOptions& base) {
  pipeline::EstimateOptions options = base;
  options.solve.solver = solver;
  options.classical = classical;
  const std::string name = std::string(lighting::solver_name(solver)) + ", " + options.separator_name();
  return {name, std::move(options)};
}

std::vector<pipeline::Estimator> estimators_of(const std::vector<DirectionSetting>& settings) {
  std::vector<pipeline::Estimator> estimators;
  estimators.reserve(settings.size());
  for (const DirectionSetting& setting : settings) estimators.emplace_back(setting.options);
  return estimators;
}

}  // namespace faceprobe::cli
