#include "paper/derived_tables.h"

#include "faceprobe/eval/sun_metrics.h"
#include "paper/yale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace faceprobe::cli {

namespace {

using eval::Better;
using eval::ReportTable;

std::optional<double> spread_of(const ReportTable& table, const std::string& name) {
  const auto row = std::ranges::find(table.rows, name, &ReportTable::Row::name);
  if (row == table.rows.end()) return std::nullopt;
  std::vector<double> means;
  for (const std::optional<double>& mean : row->values) {
    if (mean && std::isfinite(*mean)) means.push_back(*mean);
  }
  if (means.size() < 2) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(means);
  return least > 0 ? std::optional(most / least) : std::nullopt;
}

std::optional<double> median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::ranges::sort(values);
  const double middle = eval::quantile_of_sorted(values, 0.5);
  return std::isfinite(middle) ? std::optional(middle) : std::nullopt;
}

}  // namespace

ReportTable worst_over_best(const std::vector<std::pair<std::string, ReportTable>>& by_group, const std::string& title) {
  ReportTable table{.title = title,
                    .columns = {},
                    .decimals = std::vector<int>(by_group.size(), 2),
                    .better = std::vector<Better>(by_group.size(), Better::kNeither)};
  for (const auto& one : by_group) table.columns.push_back(one.first);
  if (by_group.empty()) return table;
  for (const ReportTable::Row& first : by_group.front().second.rows) {
    ReportTable::Row row{.name = first.name, .ours = first.ours};
    for (const auto& one : by_group) row.values.push_back(spread_of(one.second, first.name));
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable sun_table(const eval::ScoreTable& scores, const std::string& title, const std::set<std::string>& ours,
                      const std::string& group, const std::string& label) {
  ReportTable table{.title = title, .note = "No answer counts as 180 degrees off.", .columns = {}};
  for (const int angle : eval::SunCurve::kAnglesDeg) table.columns.push_back("within " + std::to_string(angle));
  table.decimals.assign(table.columns.size(), 0);
  table.better.assign(table.columns.size(), Better::kHigher);
  table.columns.insert(table.columns.end(), {"75 % within, degrees", "n"});
  table.decimals.insert(table.decimals.end(), {1, 0});
  table.better.insert(table.better.end(), {Better::kLower, Better::kNeither});
  for (const std::string& method : scores.methods()) {
    const eval::Selection rows{method, group, label};
    const std::vector<double> errors = scores.known_values("sun_centroid", rows);
    if (errors.empty()) continue;
    const eval::SunCurve curve = eval::sun_curve(errors, {}, scores.known_persons("sun_centroid", rows));
    ReportTable::Row row{.name = method, .ours = ours.contains(method)};
    for (const double share : curve.within) row.values.emplace_back(100 * share);
    row.values.insert(row.values.end(), {curve.mark_deg, static_cast<double>(curve.count)});
    row.intervals.resize(curve.within.size());
    row.intervals.emplace_back();
    if (std::isfinite(curve.mark_low_deg)) row.intervals.back() = {curve.mark_low_deg, curve.mark_high_deg};
    if (curve.missing > 0) row.note = std::to_string(curve.missing) + " missing";
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable medians_by_flash(const eval::ScoreTable& scores, const std::string& metric, const std::string& title,
                             const std::set<std::string>& ours) {
  constexpr std::size_t kWithin50 = 3;  // subsets of the database
  const std::vector<std::string> labels = yale_flash_labels();
  ReportTable table{.title = title, .columns = labels};
  table.columns.insert(table.columns.end(),
                       {"within 50", "all, within " + std::to_string(std::lround(kYaleMaxAxisDeg))});
  table.decimals.assign(table.columns.size(), 1);
  table.better.assign(table.columns.size(), Better::kLower);
  for (const std::string& method : scores.methods()) {
    ReportTable::Row row{.name = method, .ours = ours.contains(method)};
    std::vector<double> pooled;
    for (std::size_t k = 0; k < labels.size(); ++k) {
      const std::vector<double> values = scores.known_values(metric, {method, "flash", labels[k]});
      row.values.push_back(median(values));
      if (k < kWithin50) pooled.insert(pooled.end(), values.begin(), values.end());
    }
    const std::vector<double> all = scores.known_values(metric, {.method = method});
    if (all.empty()) continue;
    row.values.insert(row.values.end(), {median(std::move(pooled)), median(all)});
    const auto missing = std::ranges::count_if(all, [](double value) { return !std::isfinite(value); });
    if (missing > 0) row.note = std::to_string(missing) + " missing";
    table.rows.push_back(std::move(row));
  }
  // Medians over fewer pictures do not compare; a method without any answer takes nobody's place.
  const bool alike = std::ranges::all_of(
      table.rows, [](const ReportTable::Row& row) { return row.note.empty() || !row.values.back(); });
  if (!alike) table.better.assign(table.columns.size(), Better::kNeither);
  return table;
}

}  // namespace faceprobe::cli
