#pragma once
// The few figures of the report that a first page quotes.
//
//   const std::string table = headlines(eval::report_from_json(text));

#include "faceprobe/eval/paper_report.h"

#include <string>

namespace faceprobe::cli {

// A Markdown table: what was measured, ours, the best of the others. What knows the truth, or is ours with another option, is no rival, but the
// paper's own solver and network are; what an earlier version measured says so; a figure that the report lacks has no line. Throws Error(kInput) where it has none of them.
std::string headlines(const eval::PaperReport& report);

}  // namespace faceprobe::cli
