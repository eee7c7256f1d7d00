#pragma once
// Figures as the paper prints them, to stand beside ours: other heads, maps and renderers, so they compare in order, not in size.

#include "faceprobe/eval/paper_report.h"

#include <vector>

namespace faceprobe::cli {

std::vector<eval::ReportTable> published_highlights();  // Table 1: layers of 100 synthetic faces, and of 30 real ones
std::vector<eval::ReportTable> published_relighting();  // Table 2: a bunny under 500 lights, outdoor and indoor
eval::ReportTable published_maps();                     // the supplement's errors of maps in 15 real scenes

}  // namespace faceprobe::cli
