#include "faceprobe/eval/case_report.h"

#include "eval/case_pictures.h"
#include "faceprobe/core/error.h"

#include <map>
#include <utility>

namespace faceprobe::eval {
namespace {

struct Metric {
  const char* name;
  const char* title;
  int decimals;
  Better better = Better::kLower;
};

void add_table(ReportSection& section, const ScoreTable& scores, const Metric& metric,
               const std::set<std::string>& ours) {
  if (scores.known_values(metric.name).empty()) return;
  section.tables.push_back(table_of(scores, metric.name, metric.title, metric.decimals, ours, metric.better));
}

// By each of the cases' own groups that has more than one label.
void add_group_tables(ReportSection& section, const ScoreTable& scores, const Metric& metric,
                      const std::set<std::string>& ours) {
  for (const std::string& group : scores.groups()) {
    if (group == "failure" || scores.labels(group).size() < 2) continue;
    section.tables.push_back(table_by_group(scores, metric.name, group, std::string(metric.title) + " by " + group,
                                            metric.decimals, ours, metric.better));
  }
}

void add_picture(ReportSection& section, ReportPicture picture) {
  if (!picture.picture.empty()) section.pictures.push_back(std::move(picture));
}

ReportSection relighting_section(const CaseScores& scores, const CaseReport& options) {
  ReportSection section{.id = "relighting",
                        .title = "An object in the light that was found",
                        .text = options.object +
                                " in the estimated light against the same in the true one, RMSE of 255. Each picture "
                                "is divided by the brightest pixel of its own diffuse one."};
  for (const Metric& metric : {Metric{"diffuse", "Diffuse object", 1}, Metric{"glossy", "Glossy object", 1}}) {
    add_table(section, scores.light, metric, options.ours);
    add_group_tables(section, scores.light, metric, options.ours);
    section.plots.push_back(histogram_of(scores.light, metric.name, std::string(metric.title) + ": cases by error",
                                         "RMSE of 255", options.ours));
  }
  add_picture(section, light_picture(scores, options));
  return section;
}

ReportSection map_section(const CaseScores& scores, const CaseReport& options) {
  ReportSection section{.id = "maps",
                        .title = "The maps themselves",
                        .text =
                            "Three spheres in both lights after the best scale, and the maps over the range of the "
                            "true one."};
  for (const Metric& metric :
       {Metric{"si_diffuse", "Diffuse sphere", 3}, Metric{"si_matte", "Rough metal sphere", 3},
        Metric{"si_mirror", "Mirror sphere", 3}, Metric{"nrmse_map_truth", "Map, NRMSE over the truth's range", 3},
        Metric{"colour", "Colour of all the light, degrees", 2}})
    add_table(section, scores.light, metric, options.ours);
  return section;
}

ReportSection main_light_section(const CaseScores& scores, const CaseReport& options) {
  ReportSection section{.id = "main_light",
                        .title = "The main light",
                        .text =
                            "The angle between the true main light and the one found, of cases that one lamp "
                            "dominates."};
  add_table(section, scores.light, {"main_light", "Main light, degrees", 1}, options.ours);
  section.plots = {
      cumulative_of(scores.light, "main_light", "Cases within an error of the main light", "degrees", options.ours)};
  section.plots[0].missing_are_largest = true;
  return section;
}

ReportSection highlight_section(const CaseScores& scores, const CaseReport& options) {
  ReportSection section{.id = "highlights",
                        .title = "Highlight layers",
                        .text = "Linear light, 0 to 255, where the case's mask says that highlights are judged."};
  const Metric rmse{"rmse", "RMSE of the highlight layer", 2};
  add_table(section, scores.highlight, rmse, options.ours);
  add_table(section, scores.highlight, {"ssim", "SSIM of the highlight layer", 3, Better::kHigher}, options.ours);
  add_group_tables(section, scores.highlight, rmse, options.ours);
  section.plots = {
      histogram_of(scores.highlight, "rmse", "Cases by RMSE of the highlight layer", "RMSE, 0-255", options.ours)};
  add_picture(section, highlight_picture(scores, options));
  return section;
}

}  // namespace

std::string failures_text(const std::vector<CaseFailure>& failures, const std::string& what) {
  std::map<std::pair<std::string, std::string>, int> cases;
  for (const CaseFailure& failure : failures) ++cases[{failure.method, failure.reason}];
  std::string text;
  for (const auto& [of, count] : cases) {
    text += (text.empty() ? "" : " ") + of.first + " has no result for " + std::to_string(count) + " " + what +
            (count == 1 ? ": " : "s: ") + of.second + ".";
  }
  return text;
}

std::string CaseReport::validate() const {
  if (data.empty() || work.empty()) return "The report wants both folders, of the cases and of what was written.";
  if (rows < 0 || rows > 200) return "rows is " + std::to_string(rows) + "; allowed is 0 to 200.";
  return {};
}

PaperReport case_report(const CaseScores& scores, const CaseReport& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  PaperReport report{.title = "Light from faces: cases", .made_with = options.made_with};
  if (!scores.light.rows().empty()) {
    report.sections.push_back(relighting_section(scores, options));
    report.sections.push_back(map_section(scores, options));
  }
  if (!scores.light.known_values("main_light").empty()) report.sections.push_back(main_light_section(scores, options));
  if (!scores.highlight.rows().empty()) report.sections.push_back(highlight_section(scores, options));
  ReportSection runs{.id = "runs",
                     .title = "The runs",
                     .text = "Time is that of the first run: what is known is not run again.",
                     .missing = failures_text(scores.failures, "case")};
  add_table(runs, scores.runs, {"seconds", "Seconds a case", 2}, options.ours);
  report.sections.push_back(std::move(runs));
  return report;
}

}  // namespace faceprobe::eval
