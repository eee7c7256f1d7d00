#pragma once
// Rows and sections that a report lacks, from an earlier report of the same measurement. Rivals whose weights take hours to train need not be trained again by
// everybody who measures something else on the same photos.
//
//   const std::set<std::string> taken = add_earlier_rows(report, report_from_json(io::read_text("docs/results.json", kMostBytes)));
//
// Not for other photos: that they are the same is not taken on trust. A table takes rows only where a row that both reports have is the same to
// four digits, such as what an empty answer scores.

#include "faceprobe/eval/paper_report.h"

#include <set>
#include <string>
#include <vector>

namespace faceprobe::eval {

// Adds to each table of `report` the rows that the table of the same section and title in `earlier` has beside, with the note "earlier". Values of
// columns that the table does not have are dropped, those of columns that the row does not have are missing. Sections say below their text which
// rows came so, and no longer that these are missing. Plots stay as they are. Returns the names of the rows taken.
std::set<std::string> add_earlier_rows(PaperReport& report, const PaperReport& earlier);

// Adds the sections of `earlier` that `report` does not have, with a sentence that says so; sections are then in the order of `earlier`, and those
// that only `report` has at the end. Returns the titles of the sections added.
std::vector<std::string> add_earlier_sections(PaperReport& report, const PaperReport& earlier);

// Whether a row, or all of a section, came from an earlier report by these functions.
bool is_earlier(const ReportTable::Row& row);
bool is_earlier(const ReportSection& section);

}  // namespace faceprobe::eval
