#pragma once
// How far the methods of a report's table are from ours, sample by sample: intervals of means overlap where the same hard photos widen both, those of
// differences tell the two apart.
//
//   section.tables.push_back(paired_table_of(scores, "diffuse", "Diffuse object", 1, {"net"}));

#include "faceprobe/eval/paper_report.h"

#include <set>
#include <string>

namespace faceprobe::eval {

inline constexpr const char* kDifferenceColumn = "minus ours";

// table_of() with a column more: the mean of each row's differences to the first of `ours` that has the metric (ScoreTable::difference), with its
// interval, and below the table what they are. Missing for that row itself and where no sample has both; no such column where none of `ours` has
// the metric.
ReportTable paired_table_of(const ScoreTable& scores, const std::string& metric, const std::string& title, int decimals,
                            const std::set<std::string>& ours, Better better = Better::kLower);

}  // namespace faceprobe::eval
