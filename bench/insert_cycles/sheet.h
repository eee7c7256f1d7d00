#pragma once
// Pictures of both renderers beside one another, to be looked at.

#include "faceprobe/core/image.h"

#include <filesystem>
#include <vector>

namespace faceprobe::bench {

struct Pair {
  Image ours, cycles;  // 4 channels, premultiplied
};

// One row per entry of `rows`; in it, for every pair, ours, Cycles' and ten times their difference, all at Cycles' exposure.
void write_sheet(const std::filesystem::path& path, const std::vector<std::vector<Pair>>& rows);

}  // namespace faceprobe::bench
