#include "faceprobe/eval/paired_column.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr const char* kDifferenceNote =
    "Minus ours: the mean difference to our row, photo by photo, over the photos that both answered. Its interval "
    "draws people, and leaves out 0 "
    "where the two differ by more than chance explains.";

}  // namespace

ReportTable paired_table_of(const ScoreTable& scores, const std::string& metric, const std::string& title, int decimals,
                            const std::set<std::string>& ours, Better better) {
  ReportTable table = table_of(scores, metric, title, decimals, ours, better);
  const auto reference = std::ranges::find_if(
      ours, [&](const std::string& name) { return !scores.known_values(metric, {.method = name}).empty(); });
  if (reference == ours.end()) return table;
  const std::size_t column = table.columns.size();
  table.columns.emplace_back(kDifferenceColumn);
  table.decimals.push_back(decimals);
  table.better.push_back(Better::kNeither);
  for (ReportTable::Row& row : table.rows) {
    row.values.resize(column + 1);
    row.intervals.resize(column + 1);
    if (row.name == *reference) continue;
    const Summary s = scores.difference(metric, *reference, {.method = row.name});
    if (std::isfinite(s.mean)) row.values[column] = s.mean;
    if (std::isfinite(s.mean_low) && std::isfinite(s.mean_high)) row.intervals[column] = {s.mean_low, s.mean_high};
  }
  table.note = kDifferenceNote;
  return table;
}

}  // namespace faceprobe::eval
