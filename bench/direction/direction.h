#pragma once
// The two halves of bench_direction; each prints its Markdown tables. `weights`: of the highlight network; empty = those that come with
// the program.

#include <filesystem>
#include <string>

namespace faceprobe::bench {

// Extended Yale B: one flash of known direction at a time, grey pictures, landmarks given.
void report_yale(const std::filesystem::path& folder, int every, const std::filesystem::path& weights);
// London: the same three studio lights, measured, on every person.
void report_london(const std::filesystem::path& folder, int every, const std::filesystem::path& weights);

}  // namespace faceprobe::bench
