#pragma once
// Figures as the paper prints them, to stand beside ours: other heads, maps and renderers, so they compare in order, not in size.

#include "faceprobe/eval/paper_report.h"

namespace faceprobe::cli {

eval::ReportTable published_highlights();  // Table 1: layers of 100 synthetic faces
eval::ReportTable published_relighting();  // Table 2: a bunny under 500 lights, outdoor and indoor

}  // namespace faceprobe::cli
