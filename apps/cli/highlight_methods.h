#pragma once
// The rows of the benchmarks of highlight layers: the classical separators, and networks by their weights.

#include "faceprobe/eval/highlight_benchmark.h"

#include <string>
#include <vector>

namespace faceprobe::cli {

// A black layer, Tan & Ikeuchi, Yang, Shen & Zheng, and Li et al. as far as it is known.
std::vector<eval::HighlightMethod> classical_highlight_methods(int threads);
// `named`: FILE or NAME=FILE. `device`: as net::device_from_name() reads it; the networks of estimates have no use for it. Throws Error(kModel),
// Error(kUsage) and Error(kDevice).
eval::HighlightMethod network_highlight_method(const std::string& named, const std::string& device, int threads);

}  // namespace faceprobe::cli
