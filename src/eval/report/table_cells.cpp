#include "eval/report/table_cells.h"

#include "eval/markdown.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr int kUsualDecimals = 3;
constexpr int kMostDecimals = 17;

// Rounded; no "-0.00".
std::string shown(double value, int decimals) {
  std::string text = rounded(value, decimals);
  const bool nothing = text.find_first_of("123456789") == std::string::npos;
  return nothing && text.starts_with('-') && text.size() > 1 ? text.substr(1) : text;
}

int decimals_of(const ReportTable& table, std::size_t column) {
  return column < table.decimals.size() ? std::clamp(table.decimals[column], 0, kMostDecimals) : kUsualDecimals;
}

// As it is shown; empty where there is nothing to compare.
std::string best_of(const ReportTable& table, std::size_t column) {
  const Better better = better_of(table, column);
  if (better == Better::kNeither) return {};
  std::vector<double> values;
  for (const ReportTable::Row& row : table.rows) {
    const std::optional<double> value = row.bound ? std::nullopt : value_at(row, column);
    if (value) values.push_back(*value);
  }
  if (values.size() < 2) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return shown(better == Better::kLower ? *least : *most, decimals_of(table, column));
}

}  // namespace

Better better_of(const ReportTable& table, std::size_t column) {
  return column < table.better.size() ? table.better[column] : Better::kNeither;
}

std::optional<double> value_at(const ReportTable::Row& row, std::size_t column) {
  if (column >= row.values.size() || !row.values[column] || !std::isfinite(*row.values[column])) return std::nullopt;
  return row.values[column];
}

std::optional<std::pair<double, double>> interval_at(const ReportTable::Row& row, std::size_t column) {
  if (column >= row.intervals.size() || !row.intervals[column]) return std::nullopt;
  const auto& interval = *row.intervals[column];
  if (!std::isfinite(interval.first) || !std::isfinite(interval.second)) return std::nullopt;
  return interval;
}

std::vector<std::vector<TableCell>> table_cells(const ReportTable& table) {
  std::vector<std::vector<TableCell>> out;
  for (const ReportTable::Row& row : table.rows) {
    if (row.values.size() > table.columns.size()) {
      throw std::invalid_argument("the table \"" + table.title + "\": row " + row.name + " has " +
                                  std::to_string(row.values.size()) + " values for " +
                                  std::to_string(table.columns.size()) + " columns");
    }
    out.emplace_back(table.columns.size());
  }
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const int decimals = decimals_of(table, column);
    const std::string best = best_of(table, column);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      TableCell& cell = out[i][column];
      const std::optional<double> value = value_at(table.rows[i], column);
      cell.value = value ? shown(*value, decimals) : "-";
      cell.best = value && !table.rows[i].bound && cell.value == best;
      if (const auto interval = interval_at(table.rows[i], column)) {
        cell.interval = '[' + shown(interval->first, decimals) + ", " + shown(interval->second, decimals) + ']';
      }
    }
  }
  return out;
}

}  // namespace faceprobe::eval
