#pragma once
// What rows and tables are called in the report, and which rows are bounds. Methods have short names where they are measured; in the report some
// of them would be mistaken: "tan" is a skin tone as well, and "paper" is not the paper's whole system.

#include "faceprobe/eval/paper_report.h"

#include <string>
#include <string_view>

namespace faceprobe::cli {

// "tan, published" -> "Tan & Ikeuchi 2004, published". A name of the report stays as it is.
std::string row_name(const std::string& method);

// Whether a row was told a part of the truth, and so is no rival.
bool is_bound(std::string_view row);

// Gives rows, series, tables and columns these names, those of reports that earlier versions wrote too, marks bounds, and leaves out rows that were
// asked for nothing. Twice is as once.
void name_rows(eval::PaperReport& report);

}  // namespace faceprobe::cli
