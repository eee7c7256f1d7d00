#pragma once
// The two halves of bench_direction; each prints its Markdown tables. What is measured, and how, is in apps/cli/paper. `base`: what their rows
// share, such as weights, and what is tried.

#include "faceprobe/eval/score_table.h"
#include "faceprobe/pipeline/estimate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

// Extended Yale B: one flash of known direction at a time, grey pictures, landmarks given.
void report_yale(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base);
// London: the same three studio lights, measured, on every person.
void report_london(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base);

// The values of the selected rows that have an answer.
std::vector<double> answers(const eval::ScoreTable& scores, const std::string& metric, const eval::Selection& rows);

}  // namespace faceprobe::bench
