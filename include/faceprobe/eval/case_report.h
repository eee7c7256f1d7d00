#pragma once
// What measure_cases() found as one page, of the parts that the report of the paper's evaluation is made of (eval/paper_report.h): tables, plots, and
// pictures of some cases with what each method wrote.
//
//   const eval::CaseScores scores = eval::measure_cases("cases", methods, {.work = "out/cache"});
//   const eval::PaperReport report = eval::case_report(scores, {.data = "cases", .work = "out/cache"});
//   io::write_file_atomically("out/cases.html", eval::report_html(report));

#include "faceprobe/eval/case_benchmark.h"
#include "faceprobe/eval/paper_report.h"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::eval {

struct CaseReport {
  std::filesystem::path data;       // the cases and ...
  std::filesystem::path work;       // ... the folder of results, as measure_cases() had them
  std::string made_with = {};       // version and data
  std::set<std::string> ours{};     // names of methods that are set off
  std::string object = "A sphere";  // what stands in the light, for the text
  std::function<LitObject()> draw = [] { return LitObject(sphere_mesh()); };  // the same, for pictures; of nside 16
  int rows = 8;  // cases in each picture, spread evenly; 0: no pictures

  std::string validate() const;
};

// A sentence for each method and reason, with the number of cases, which `what` names in the singular; empty without failures. There may be
// thousands of cases with one reason.
std::string failures_text(const std::vector<CaseFailure>& failures, const std::string& what);

// Sections "relighting", "maps", "main_light" and "highlights", those that have rows, and "runs": seconds, and what is missing with its reasons. A
// method has a black cell where it wrote nothing. Throws Error(kUsage) for options that do not validate, Error(kInput) for a case that can no longer
// be read.
PaperReport case_report(const CaseScores& scores, const CaseReport& options);

}  // namespace faceprobe::eval
