#pragma once
// The estimate with one part of it changed at a time: what each part is worth.

#include "faceprobe/eval/relight_benchmark.h"
#include "relight_methods.h"

#include <vector>

namespace faceprobe::cli {

// The first row is the estimate as it is. `rows.training` and `rows.ablation` are not asked.
std::vector<eval::LightMethod> ablation_methods(const RelightRows& rows);

}  // namespace faceprobe::cli
