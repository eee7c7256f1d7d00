// The table as text: CSV for other programs, JSON with the summaries, Markdown for people.
#include "eval/csv_text.h"
#include "eval/markdown.h"
#include "faceprobe/eval/score_table.h"

#include <nlohmann/json.hpp>

namespace faceprobe::eval {
namespace {

using Json = nlohmann::ordered_json;

std::string interval(const Summary& s, int decimals) {
  return '[' + rounded(s.mean_low, decimals) + ", " + rounded(s.mean_high, decimals) + ']';
}

// "100", "100 of 32 people", "97 of 32 people (3 missing)".
std::string counted_people(const Summary& s) {
  const std::string people =
      s.people < s.count ? " of " + std::to_string(s.people) + (s.people == 1 ? " person" : " people") : "";
  const std::string missing = s.missing > 0 ? " (" + std::to_string(s.missing) + " missing)" : "";
  return std::to_string(s.count) + people + missing;
}

Json row_json(const ScoreRow& row) {
  Json out = {{"method", row.method}, {"sample", row.sample}};
  if (!row.person.empty()) out["person"] = row.person;
  out.update({{"groups", Json(row.groups)}, {"metrics", Json(row.metrics)}});
  return out;
}

// Numbers that are not finite become null as nlohmann::json writes them.
Json summary_json(const std::string& metric, const Selection& selection, const Summary& s) {
  Json out = {{"metric", metric}, {"method", selection.method}};
  if (!selection.group.empty()) out.update({{"group", selection.group}, {"label", selection.label}});
  out.update({{"count", s.count},
              {"people", s.people},
              {"missing", s.missing},
              {"mean", s.mean},
              {"mean_95", Json::array({s.mean_low, s.mean_high})},
              {"median", s.median},
              {"p90", s.p90}});
  return out;
}

}  // namespace

std::string ScoreTable::csv() const {
  std::string out = "method,sample,person";
  for (const std::string& group : groups_) out += ',' + csv_cell(group);
  for (const std::string& metric : metrics_) out += ',' + csv_cell(metric);
  out += "\r\n";
  for (const ScoreRow& row : rows_) {
    out += csv_cell(row.method) + ',' + csv_cell(row.sample) + ',' + csv_cell(row.person);
    for (const std::string& group : groups_) {
      const auto found = row.groups.find(group);
      out += ',' + (found != row.groups.end() ? csv_cell(found->second) : std::string());
    }
    for (const std::string& metric : metrics_) {
      const auto found = row.metrics.find(metric);
      out += ',' + (found != row.metrics.end() ? exact(found->second) : std::string());
    }
    out += "\r\n";
  }
  return out;
}

std::string ScoreTable::json() const {
  Json rows = Json::array();
  for (const ScoreRow& row : rows_) rows.push_back(row_json(row));
  Json summaries = Json::array();
  const auto add_summary = [&](const std::string& metric, const Selection& selection) {
    summaries.push_back(summary_json(metric, selection, summary(metric, selection)));
    if (!compares() || selection.method == reference_) return;
    const Summary s = difference(metric, reference_, selection);
    summaries.back()["minus"] = {{"method", reference_},
                                 {"count", s.count},
                                 {"people", s.people},
                                 {"mean", s.mean},
                                 {"mean_95", Json::array({s.mean_low, s.mean_high})}};
  };
  for (const std::string& metric : metrics_) {
    for (const std::string& method : methods()) {
      add_summary(metric, {.method = method});
      for (const std::string& group : groups_) {
        for (const std::string& label : labels(group)) add_summary(metric, {method, group, label});
      }
    }
  }
  const Json out = {{"bootstrap", {{"seed", bootstrap_.seed}, {"resamples", bootstrap_.resamples}}},
                    {"rows", rows},
                    {"summaries", summaries}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string ScoreTable::markdown(const std::string& metric, int decimals) const {
  std::vector<std::string> titles = {metric, "n", "mean", "95 % of the mean", "median", "p90"};
  if (compares()) titles.push_back("minus " + reference_);
  std::string out = markdown_head(titles);
  for (const std::string& method : methods()) {
    const Summary s = summary(metric, {.method = method});
    out += "| " + markdown_cell(method) + " | " + counted_people(s) + " | " + rounded(s.mean, decimals) + " | " +
           interval(s, decimals) + " | " + rounded(s.median, decimals) + " | " + rounded(s.p90, decimals) + " |";
    if (compares() && method == reference_) out += " |";
    if (compares() && method != reference_) {
      const Summary d = difference(metric, reference_, {.method = method});
      out += ' ' + rounded(d.mean, decimals) + ' ' + interval(d, decimals) + " |";
    }
    out += '\n';
  }
  return out;
}

std::string ScoreTable::markdown_by_group(const std::string& metric, const std::string& group, int decimals) const {
  const std::vector<std::string> columns = labels(group);
  std::vector<std::string> titles = {metric};
  titles.insert(titles.end(), columns.begin(), columns.end());
  std::string out = markdown_head(titles);
  for (const std::string& method : methods()) {
    out += "| " + markdown_cell(method) + " |";
    for (const std::string& label : columns) {
      const Summary s = summary(metric, {method, group, label});
      out += ' ' + rounded(s.mean, decimals) + ' ' + interval(s, decimals) + ", n = " + counted_people(s) + " |";
    }
    out += '\n';
  }
  return out;
}

}  // namespace faceprobe::eval
