#pragma once
// What a reader has to know before figures of the report are compared, and what its words mean. All in one place, so that a report of an earlier
// version is read with the same warnings.
//
//   make_readable(report);  // after sections are put together, and after a report is read

#include "faceprobe/eval/paper_report.h"

namespace faceprobe::cli {

// Names (report_names.h), the glossary, notes of sections and tables; values of a table that ranks nothing are not compared. Twice is as once.
void make_readable(eval::PaperReport& report);

}  // namespace faceprobe::cli
