#pragma once
// The ways of estimating that are compared where the true direction of the light is known.

#include "faceprobe/pipeline/estimate.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::cli {

struct DirectionSetting {
  std::string name;
  pipeline::EstimateOptions options = {};
  bool linear_codes = true;  // of grey pictures without a profile: code values are light; else they are taken for sRGB
};

// What no look at the photo gives: a light straight ahead, beside the settings.
inline constexpr const char* kStraightAhead = "straight ahead, no estimate";

// Called after each photo, once all settings have seen it.
using PhotoDone = std::function<void()>;

// "transport, net": `base` with this solver, and this classical separator in the place of the network.
DirectionSetting direction_setting(lighting::Solver solver, const std::optional<highlight::Separator>& classical,
                                   const pipeline::EstimateOptions& base);

// "mesh", "net", "3dmm": what options call a source of normals.
std::string_view normals_option(pipeline::NormalSource normals);
// "normals of the mesh": `base` with these; its surface_fit has to be there for those of the fitted head.
DirectionSetting normals_setting(pipeline::NormalSource normals, const pipeline::EstimateOptions& base);

// Loads the models of each.
std::vector<pipeline::Estimator> estimators_of(const std::vector<DirectionSetting>& settings);

}  // namespace faceprobe::cli
