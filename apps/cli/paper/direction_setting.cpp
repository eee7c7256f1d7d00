#include "paper/direction_setting.h"

#include <utility>

namespace faceprobe::cli {

DirectionSetting direction_setting(lighting::Solver solver, const std::optional<highlight::Separator>& classical,
                                   const pipeline::EstimateOptions& base) {
  pipeline::EstimateOptions options = base;
  options.solve.solver = solver;
  options.classical = classical;
  const std::string name = std::string(lighting::solver_name(solver)) + ", " + options.separator_name();
  return {name, std::move(options)};
}

std::string_view normals_option(pipeline::NormalSource normals) {
  switch (normals) {
    case pipeline::NormalSource::kMesh: return "mesh";
    case pipeline::NormalSource::kFit: return "3dmm";
    case pipeline::NormalSource::kNet: break;
  }
  return "net";
}

DirectionSetting normals_setting(pipeline::NormalSource normals, const pipeline::EstimateOptions& base) {
  pipeline::EstimateOptions options = base;
  options.normals = normals;
  switch (normals) {
    case pipeline::NormalSource::kMesh: return {"normals of the mesh", std::move(options)};
    case pipeline::NormalSource::kFit: return {"normals of a fitted head model", std::move(options)};
    case pipeline::NormalSource::kNet: break;
  }
  return {"normals of the net", std::move(options)};
}

std::vector<pipeline::Estimator> estimators_of(const std::vector<DirectionSetting>& settings) {
  std::vector<pipeline::Estimator> estimators;
  estimators.reserve(settings.size());
  for (const DirectionSetting& setting : settings) estimators.emplace_back(setting.options);
  return estimators;
}

}  // namespace faceprobe::cli
