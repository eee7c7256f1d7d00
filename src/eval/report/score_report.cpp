// Tables and plots of scores.
#include "eval/markdown.h"
#include "faceprobe/eval/paper_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace faceprobe::eval {
namespace {

std::optional<double> known(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

std::optional<std::pair<double, double>> mean_interval(const Summary& s) {
  if (!std::isfinite(s.mean_low) || !std::isfinite(s.mean_high)) return std::nullopt;
  return std::pair(s.mean_low, s.mean_high);
}

// A method fails where its metric is NaN; rows without the metric do not belong to the measurement.
struct Counts {
  std::size_t finite = 0;
  std::size_t missing = 0;
};
Counts counts_of(const ScoreTable& scores, const std::string& metric, const Selection& rows) {
  const std::vector<double> values = scores.known_values(metric, rows);
  const auto finite = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); }));
  return {finite, values.size() - finite};
}

// Those that were asked for the metric at all, in the order of the table.
std::vector<std::string> methods_with(const ScoreTable& scores, const std::string& metric) {
  std::vector<std::string> methods = scores.methods();
  std::erase_if(methods,
                [&](const std::string& method) { return scores.known_values(metric, {.method = method}).empty(); });
  return methods;
}

// The number of samples beside the label where it is the same for all methods, else beside each method's name; there too what is missing.
void tell_counts(ReportTable& table, const std::vector<std::vector<Counts>>& counts) {
  const auto same_total = [](const Counts& a, const Counts& b) { return a.finite + a.missing == b.finite + b.missing; };
  const bool same = std::all_of(counts.begin(), counts.end(), [&](const std::vector<Counts>& c) {
    return std::equal(c.begin(), c.end(), counts.front().begin(), same_total);
  });
  for (std::size_t i = 0; i < table.columns.size() && !counts.empty(); ++i) {
    const std::string label = table.columns[i];
    if (same) table.columns[i] += ", n = " + std::to_string(counts.front()[i].finite + counts.front()[i].missing);
    for (std::size_t m = 0; m < counts.size(); ++m) {
      const Counts& c = counts[m][i];
      std::string told_count = same ? "" : label + " n = " + counted(c.finite, c.missing);
      if (same && c.missing > 0) told_count = label + ' ' + std::to_string(c.missing) + " missing";
      std::string& note = table.rows[m].note;
      if (!told_count.empty()) note += (note.empty() ? "" : ", ") + told_count;
    }
  }
}

// Means over the samples that all methods answered which answered any: means over different samples do not compare. Nothing where all answered
// all of them, or there is no such sample.
struct CommonMeans {
  std::vector<std::optional<double>> of_method;
  std::size_t samples = 0;
};
std::optional<CommonMeans> common_means(const ScoreTable& scores, const std::string& metric) {
  const std::vector<std::string> methods = methods_with(scores, metric);
  std::map<std::string, std::map<std::string, double>> answers;  // of each method
  std::set<std::string> samples;
  for (const ScoreRow& row : scores.rows()) {
    const auto found = row.metrics.find(metric);
    if (found == row.metrics.end()) continue;
    samples.insert(row.sample);
    if (std::isfinite(found->second)) answers[row.method][row.sample] = found->second;
  }
  const std::size_t all = samples.size();
  for (const auto& [method, known] : answers)
    std::erase_if(samples, [&known = known](const std::string& sample) { return !known.contains(sample); });
  if (answers.size() < 2 || samples.empty() || samples.size() == all) return std::nullopt;
  CommonMeans means{.of_method = {}, .samples = samples.size()};
  for (const std::string& method : methods) {
    double sum = 0;
    for (const std::string& sample : samples) sum += answers.contains(method) ? answers[method][sample] : 0;
    means.of_method.push_back(answers.contains(method) ? std::optional(sum / static_cast<double>(samples.size()))
                                                       : std::nullopt);
  }
  return means;
}

ReportPlot values_plot(const ScoreTable& scores, const std::string& metric, const std::string& title,
                       const std::string& unit, const std::set<std::string>& ours, PlotKind kind) {
  ReportPlot plot{.title = title, .x_label = unit, .kind = kind};
  for (const std::string& method : scores.methods()) {
    plot.series.push_back(
        {.name = method, .values = scores.known_values(metric, {.method = method}), .ours = ours.contains(method)});
  }
  return plot;
}

}  // namespace

std::string common_column(std::size_t samples) {
  return "mean of the " + std::to_string(samples) + " that all of this run have";
}

bool is_common_column(const std::string& column) {
  return column.starts_with("mean of the ") && column.ends_with(" have");
}

ReportTable table_of(const ScoreTable& scores, const std::string& metric, const std::string& title, int decimals,
                     const std::set<std::string>& ours, Better better) {
  ReportTable table{.title = title,
                    .columns = {"mean", "median", "n"},
                    .decimals = {decimals, decimals, 0},
                    .better = {better, better, Better::kNeither}};
  for (const std::string& method : methods_with(scores, metric)) {
    const Summary s = scores.summary(metric, {.method = method});
    const Counts counts = counts_of(scores, metric, {.method = method});
    table.rows.push_back({.name = method,
                          .values = {known(s.mean), known(s.median), static_cast<double>(counts.finite)},
                          .intervals = {mean_interval(s), std::nullopt, std::nullopt},
                          .ours = ours.contains(method),
                          .note = counts.missing > 0 ? std::to_string(counts.missing) + " missing" : ""});
  }
  if (const std::optional<CommonMeans> common = common_means(scores, metric)) {
    table.columns.push_back(common_column(common->samples));
    table.decimals.push_back(decimals);
    table.better = {Better::kNeither, Better::kNeither, Better::kNeither, better};
    for (std::size_t m = 0; m < table.rows.size(); ++m) table.rows[m].values.push_back(common->of_method[m]);
  }
  return table;
}

ReportTable table_by_group(const ScoreTable& scores, const std::string& metric, const std::string& group,
                           const std::string& title, int decimals, const std::set<std::string>& ours, Better better) {
  const std::vector<std::string> labels = scores.labels(group);
  const std::vector<std::string> methods = methods_with(scores, metric);
  ReportTable table{.title = title,
                    .columns = labels,
                    .decimals = std::vector<int>(labels.size(), decimals),
                    .better = std::vector<Better>(labels.size(), better)};
  std::vector<std::vector<Counts>> counts(methods.size());  // of each label
  for (std::size_t m = 0; m < methods.size(); ++m) {
    ReportTable::Row row{.name = methods[m], .ours = ours.contains(methods[m])};
    for (const std::string& label : labels) {
      const Selection rows{methods[m], group, label};
      const Summary s = scores.summary(metric, rows);
      row.values.push_back(known(s.mean));
      row.intervals.push_back(mean_interval(s));
      counts[m].push_back(counts_of(scores, metric, rows));
    }
    table.rows.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool alike = std::all_of(counts.begin(), counts.end(),
                                   [i](const std::vector<Counts>& c) { return c[i].missing == 0 || c[i].finite == 0; });
    if (!alike) table.better[i] = Better::kNeither;
  }
  tell_counts(table, counts);
  return table;
}

ReportTable table_of_metrics(const ScoreTable& scores, const std::vector<std::pair<std::string, std::string>>& metrics,
                             const std::string& title, int decimals, const std::set<std::string>& ours, Better better) {
  ReportTable table{.title = title,
                    .columns = {},
                    .decimals = std::vector<int>(metrics.size(), decimals),
                    .better = std::vector<Better>(metrics.size(), better)};
  for (const auto& metric : metrics) table.columns.push_back(metric.second);
  for (const std::string& method : scores.methods()) {
    ReportTable::Row row{.name = method, .ours = ours.contains(method)};
    std::size_t missing = 0;
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      const Summary s = scores.summary(metrics[i].first, {.method = method});
      row.values.push_back(known(s.mean));
      row.intervals.push_back(mean_interval(s));
      missing = std::max(missing, s.missing);
      if (s.missing > 0 && s.count > 0) table.better[i] = Better::kNeither;
    }
    if (missing > 0) row.note = std::to_string(missing) + " missing";
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportPlot histogram_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                        const std::string& unit, const std::set<std::string>& ours) {
  return values_plot(scores, metric, title, unit, ours, PlotKind::kHistogram);
}

ReportPlot cumulative_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                         const std::string& unit, const std::set<std::string>& ours) {
  return values_plot(scores, metric, title, unit, ours, PlotKind::kCumulative);
}

ReportPlot bars_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                   const std::string& unit, const std::set<std::string>& ours, const std::string& group) {
  ReportPlot plot{.title = title, .x_label = unit, .kind = PlotKind::kBars};
  if (!group.empty()) plot.groups = scores.labels(group);
  for (const std::string& method : scores.methods()) {
    ReportSeries series{.name = method, .ours = ours.contains(method)};
    std::vector<Selection> places;
    for (const std::string& label : plot.groups) places.push_back({method, group, label});
    if (group.empty()) places.push_back({.method = method});
    for (const Selection& place : places) {
      const Summary s = scores.summary(metric, place);
      series.values.push_back(s.mean);
      series.intervals.push_back(mean_interval(s));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace faceprobe::eval
