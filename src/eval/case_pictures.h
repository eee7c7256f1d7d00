#pragma once
// Internal: pictures of some cases with what each method wrote, for the report of case_report.h.

#include "faceprobe/eval/case_report.h"

namespace faceprobe::eval {

// Rows of photo, true light, and each method's, as RelightSheet draws them, of the methods in the table of light; empty where that has no rows.
ReportPicture light_picture(const CaseScores& scores, const CaseReport& options);
// Rows of photo, true highlights, and those of each method in their table, twice as bright as they are; square cells.
ReportPicture highlight_picture(const CaseScores& scores, const CaseReport& options);

}  // namespace faceprobe::eval
