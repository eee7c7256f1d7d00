#pragma once
// Tables for reports.

#include <cstddef>
#include <string>
#include <vector>

namespace faceprobe::eval {

// "-" for what is not finite; the same in any locale.
std::string rounded(double value, int decimals);
// "12", or "12 (3 missing)".
std::string counted(std::size_t count, std::size_t missing);
// A bar would end the cell, a line break the row.
std::string markdown_cell(const std::string& text);
// Titles and the line under them: the first column to the left, numbers to the right.
std::string markdown_head(const std::vector<std::string>& titles);

}  // namespace faceprobe::eval
