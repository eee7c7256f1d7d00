#pragma once
// Tables that are made from the figures of others.

#include "faceprobe/eval/paper_report.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

// The worst group over the best: of each table, by its row, the largest mean over the least; one column a table, titled by the first of each
// pair. Missing where a row has fewer than two groups, or a mean that is not positive. The rows are those of the first table.
eval::ReportTable worst_over_best(const std::vector<std::pair<std::string, eval::ReportTable>>& by_group,
                                  const std::string& title);

// How many photos have the sun within so many degrees, %, and within how many degrees three of four have it (eval/sun_metrics.h), from metric
// "sun_centroid". No answer counts as 180 degrees. Of the rows with `label` of `group` alone, where that is not empty.
eval::ReportTable sun_table(const eval::ScoreTable& scores, const std::string& title,
                            const std::set<std::string>& ours = {}, const std::string& group = {},
                            const std::string& label = {});

// Medians of `metric` over each label of group "flash" (paper/yale.h), over those within 50 degrees of the axis, and over all; of the answers.
eval::ReportTable medians_by_flash(const eval::ScoreTable& scores, const std::string& metric, const std::string& title,
                                   const std::set<std::string>& ours = {});

}  // namespace faceprobe::cli
