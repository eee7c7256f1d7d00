#include "faceprobe/eval/score_table.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

const std::set<std::string> kReserved = {"method", "sample", "person"};

bool selected(const ScoreRow& row, const Selection& selection) {
  if (!selection.method.empty() && row.method != selection.method) return false;
  if (selection.group.empty()) return true;
  const auto found = row.groups.find(selection.group);
  return found != row.groups.end() && found->second == selection.label;
}

const std::string& person_of(const ScoreRow& row) { return row.person.empty() ? row.sample : row.person; }

template <class Map>
bool any_key_in(const Map& columns, const std::set<std::string>& taken) {
  return std::any_of(columns.begin(), columns.end(), [&](const auto& column) { return taken.contains(column.first); });
}

template <class Map>
std::set<std::string> keys(const Map& columns) {
  std::set<std::string> out;
  for (const auto& column : columns) out.insert(column.first);
  return out;
}

}  // namespace

void ScoreTable::add(ScoreRow row) {
  if (row.method.empty() || row.sample.empty()) {
    throw std::invalid_argument("ScoreTable: a row needs the name of its method and of its sample");
  }
  if (any_key_in(row.groups, kReserved) || any_key_in(row.metrics, kReserved)) {
    throw std::invalid_argument("ScoreTable: no group or metric may be named \"method\", \"sample\" or \"person\"");
  }
  if (any_key_in(row.groups, metrics_) || any_key_in(row.metrics, groups_) || any_key_in(row.groups, keys(row.metrics))) {
    throw std::invalid_argument("ScoreTable: a group and a metric have the same name");
  }
  if (!known_.emplace(row.method, row.sample).second) {
    throw std::invalid_argument("ScoreTable: there is a row of " + row.method + " for " + row.sample + " already");
  }
  groups_.merge(keys(row.groups));
  metrics_.merge(keys(row.metrics));
  rows_.push_back(std::move(row));
}

void ScoreTable::order_labels(const std::string& group, std::vector<std::string> labels) {
  label_order_[group] = std::move(labels);
}

std::vector<std::string> ScoreTable::methods() const {
  std::vector<std::string> out;
  for (const ScoreRow& row : rows_) {
    if (std::find(out.begin(), out.end(), row.method) == out.end()) out.push_back(row.method);
  }
  return out;
}

std::vector<std::string> ScoreTable::labels(const std::string& group) const {
  std::set<std::string> present;
  for (const ScoreRow& row : rows_) {
    if (const auto found = row.groups.find(group); found != row.groups.end()) present.insert(found->second);
  }
  std::vector<std::string> out;
  if (const auto order = label_order_.find(group); order != label_order_.end()) {
    for (const std::string& label : order->second) {
      if (present.erase(label) > 0) out.push_back(label);
    }
  }
  out.insert(out.end(), present.begin(), present.end());
  return out;
}

std::vector<double> ScoreTable::values(const std::string& metric, const Selection& selection) const {
  std::vector<double> out;
  for (const ScoreRow& row : rows_) {
    if (!selected(row, selection)) continue;
    const auto found = row.metrics.find(metric);
    out.push_back(found != row.metrics.end() ? found->second : std::numeric_limits<double>::quiet_NaN());
  }
  return out;
}

std::vector<double> ScoreTable::known_values(const std::string& metric, const Selection& selection) const {
  std::vector<double> out;
  for (const ScoreRow& row : rows_) {
    const auto found = row.metrics.find(metric);
    if (selected(row, selection) && found != row.metrics.end()) out.push_back(found->second);
  }
  return out;
}

std::vector<std::string> ScoreTable::known_persons(const std::string& metric, const Selection& selection) const {
  std::vector<std::string> out;
  for (const ScoreRow& row : rows_) {
    if (selected(row, selection) && row.metrics.contains(metric)) out.push_back(person_of(row));
  }
  return out;
}

Summary ScoreTable::summary(const std::string& metric, const Selection& selection) const {
  return summarize(known_values(metric, selection), known_persons(metric, selection), bootstrap_);
}

Summary ScoreTable::difference(const std::string& metric, const std::string& than, const Selection& selection) const {
  if (selection.method.empty()) throw std::invalid_argument("ScoreTable: a difference is that of one method");
  std::map<std::string, double> reference;  // of each sample
  for (const ScoreRow& row : rows_) {
    const auto found = row.metrics.find(metric);
    if (row.method == than && found != row.metrics.end()) reference[row.sample] = found->second;
  }
  std::vector<double> differences;
  std::vector<std::string> persons;
  for (const ScoreRow& row : rows_) {
    const auto found = row.metrics.find(metric);
    if (!selected(row, selection) || found == row.metrics.end()) continue;
    const auto other = reference.find(row.sample);
    // Infinity less infinity is no number, and either alone is none to take a mean of: all are missing.
    differences.push_back(other == reference.end() ? std::numeric_limits<double>::quiet_NaN()
                                                   : found->second - other->second);
    persons.push_back(person_of(row));
  }
  return summarize(differences, persons, bootstrap_);
}

bool ScoreTable::compares() const {
  return !reference_.empty() &&
         std::any_of(rows_.begin(), rows_.end(), [&](const ScoreRow& row) { return row.method == reference_; });
}

Histogram ScoreTable::histogram(const std::string& metric, const Selection& selection, double low, double high,
                                int bins) const {
  return eval::histogram(values(metric, selection), low, high, bins);
}

}  // namespace faceprobe::eval
