#pragma once
// Internal: what stands in the cells of a report's table, for all that writes one.

#include "faceprobe/eval/paper_report.h"

#include <string>
#include <vector>

namespace faceprobe::eval {

struct TableCell {
  std::string value;     // "-" when missing
  std::string interval;  // "[1.0, 2.0]" or empty
  bool best = false;
};
// As many as columns. Throws std::invalid_argument for a row with more values.
std::vector<std::vector<TableCell>> table_cells(const ReportTable& table);

Better better_of(const ReportTable& table, std::size_t column);
// The value or the interval where it is there and finite.
std::optional<double> value_at(const ReportTable::Row& row, std::size_t column);
std::optional<std::pair<double, double>> interval_at(const ReportTable::Row& row, std::size_t column);

}  // namespace faceprobe::eval
