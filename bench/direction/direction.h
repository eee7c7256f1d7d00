#pragma once
// The two halves of bench_direction; each prints its Markdown tables. `base`: what their rows share, such as weights, and what is tried.

#include "faceprobe/pipeline/estimate.h"

#include <filesystem>

namespace faceprobe::bench {

// Extended Yale B: one flash of known direction at a time, grey pictures, landmarks given.
void report_yale(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base);
// London: the same three studio lights, measured, on every person.
void report_london(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base);

}  // namespace faceprobe::bench
