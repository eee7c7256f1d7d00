#include "paper/derived_tables.h"
#include "paper/london.h"
#include "paper/plan.h"
#include "paper/yale.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::cli {

namespace {

using eval::Better;
using highlight::Separator;
using lighting::Solver;

const std::set<std::string> kOurSettings = {"transport, net"};
constexpr const char* kLamp = "single lamp by least squares";

// The single lamp as a method of its own, by the classical layers, beside the settings' main lights.
eval::ScoreTable main_lights_and_lamp(const eval::ScoreTable& scores, const std::string& lamp_of) {
  eval::ScoreTable rows;
  rows.order_labels("flash", yale_flash_labels());
  for (const eval::ScoreRow& row : scores.rows()) {
    rows.add({row.method, row.sample, row.groups, {{"deg", row.metrics.at("main_light_deg")}}, row.person});
    if (row.method == lamp_of)
      rows.add({kLamp, row.sample, row.groups, {{"deg", row.metrics.at("lamp_deg")}}, row.person});
  }
  return rows;
}

eval::ReportPlot within_error(const eval::ScoreTable& scores, const std::string& metric, const std::string& title) {
  eval::ReportPlot plot = cumulative_of(scores, metric, title, "degrees", kOurSettings);
  plot.y_label = "share of the photos";
  plot.missing_are_largest = true;
  return plot;
}

eval::ReportSection yale_section(const std::vector<YalePicture>& pictures, const PaperPlan& plan, const PhotoDone& done) {
  eval::ReportSection section{
      .id = "direction_yale",
      .title = "One flash on a real face",
      .text =
          "Extended Yale B: grey pictures of faces under one flash each, up to 77 degrees off the camera's axis, "
          "with its direction. Angles between the estimate and the flash; no answer counts as missing. Grey pictures "
          "have no highlights for the classical separators, which give the same, so one stands for all three. The "
          "crops are too tight for the network's layers: only its normals are used, and the paper's solver, which "
          "lives by highlights, has no answer. The single lamp, without other light and cast shadows, is a "
          "yardstick: it is what these pictures were made with.\n\n"
          "Intervals draw people with all of their pictures. Of so few people they are still somewhat too narrow.",
      .command = "bench_direction --data DIR --set yale --every " + std::to_string(plan.direction_step())};
  if (pictures.empty()) {
    section.missing = "There are no pictures in real/yaleB of the data folder; docs/data.md says what belongs there.";
    return section;
  }
  std::set<std::filesystem::path> people;  // a folder each
  for (const YalePicture& picture : pictures) people.insert(picture.file.parent_path());
  section.text +=
      "\n\nThese are " + std::to_string(pictures.size()) + " pictures of " + std::to_string(people.size()) + " people.";
  pipeline::EstimateOptions base;
  base.threads = plan.threads;
  std::vector<DirectionSetting> settings = {direction_setting(Solver::kTransport, {}, base),
                                            direction_setting(Solver::kTransport, Separator::kYang, base),
                                            direction_setting(Solver::kPaper, {}, base)};
  settings[1].name = "transport, classical";
  const eval::ScoreTable scores = measure_yale(pictures, settings, done);
  const eval::ScoreTable main_light = main_lights_and_lamp(scores, settings[1].name);
  section.tables = {
      table_of(main_light, "deg", "Main light, degrees from the flash", 1, kOurSettings),
      table_by_group(main_light, "deg", "flash", "Main light by the flash's degrees off the axis", 1, kOurSettings),
      medians_by_flash(main_light, "deg", "Main light, median by the flash's degrees off the axis", kOurSettings),
      table_of(scores, "centroid_deg", "Centroid of all light above the median, degrees from the flash", 1, kOurSettings),
      table_by_group(scores, "centroid_deg", "flash",
                     "Centroid of all light above the median, by the flash's degrees off the axis", 1, kOurSettings)};
  section.tables[2].note = "Of the answers. Wanted is a median of 12 degrees or less within 50 degrees of the axis.";
  section.plots = {within_error(main_light, "deg", "Pictures within an error of the main light"),
                   within_error(scores, "centroid_deg", "Pictures within an error of the centroid")};
  return section;
}

double mean_answer(const eval::ScoreTable& scores, const std::string& metric, const std::string& method) {
  return scores.summary(metric, {.method = method}).mean;
}

// Means without intervals: two maps that share a person are not independent at all.
eval::ReportTable agreement_table(const eval::ScoreTable& scores) {
  struct Column {
    const char* metric;
    const char* title;
    int decimals;
    Better better;
  };
  // A constant answer agrees with itself, so small angles among estimates are not the better.
  const std::vector<Column> columns = {{"recall_deg", "true to found", 1, Better::kLower},
                                       {"precision_deg", "found to true", 1, Better::kLower},
                                       {"lights", "lights", 1, Better::kNeither},
                                       {"centroid_off_deg", "centroid", 1, Better::kNeither},
                                       {"neutral_to_smiling_deg", "by a smile", 1, Better::kNeither},
                                       {"map_correlation", "maps alike", 3, Better::kHigher}};
  eval::ReportTable table{
      .title = "All three lights, and how far people agree",
      .note =
          "Means; angles in degrees. A true light to the nearest found one, and the other way "
          "round: many lights make the first easy. The centroid of all light above the map's "
          "median to the mean one of all photos, and between a person's two photos; a constant answer agrees "
          "with itself, so that counts only beside a small error. Maps alike: correlation "
          "(Pearson, luminance, equal-area cells) of the maps of two people, over all pairs; .8 "
          "is wanted of the transport solver."};
  for (const Column& column : columns) {
    table.columns.emplace_back(column.title);
    table.decimals.push_back(column.decimals);
    table.better.push_back(column.better);
  }
  for (const std::string& method : scores.methods()) {
    eval::ReportTable::Row row{.name = method, .ours = kOurSettings.contains(method)};
    for (const Column& column : columns) {
      const double mean = mean_answer(scores, column.metric, method);
      row.values.push_back(std::isfinite(mean) ? std::optional(mean) : std::nullopt);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// `labels`: of the columns. Two photos of one person have no interval that says anything of other people.
eval::ReportTable without_lone_intervals(eval::ReportTable table, const std::vector<std::string>& labels,
                                         const LondonSet& london) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (std::ranges::count(london.people, labels[i], &LondonPerson::ethnicity) > 1) continue;
    for (eval::ReportTable::Row& row : table.rows) row.intervals.at(i).reset();
  }
  return table;
}

eval::ReportSection london_section(const LondonSet& london, const PaperPlan& plan, const PhotoDone& done) {
  eval::ReportSection section{
      .id = "direction_london",
      .title = "Three studio lights on many people",
      .text =
          "The London set: everybody sat under the same three lights, whose directions were measured from the "
          "reflections in their eyes and are known to about 5 degrees. So estimates have to agree with them, and "
          "with each other. A person counts when both photos, neutral and smiling, have an answer.\n\n"
          "Intervals draw people with both of their photos. The set does not say how light or dark a skin is; the "
          "ethnicity in its table is "
          "what comes nearest.",
      .command = "bench_direction --data DIR --set london --every " + std::to_string(plan.direction_step())};
  if (london.people.empty()) {
    section.missing =
        "There are no people with two photos in real/portraits/london of the data folder; docs/data.md says what "
        "belongs there.";
    return section;
  }
  pipeline::EstimateOptions base;
  base.threads = plan.threads;
  const eval::ScoreTable scores = measure_london(
      london,
      {direction_setting(Solver::kTransport, {}, base), direction_setting(Solver::kTransport, Separator::kYang, base),
       direction_setting(Solver::kTransport, Separator::kTan, base),
       direction_setting(Solver::kTransport, Separator::kShen, base), direction_setting(Solver::kPaper, {}, base)},
      done);
  section.tables = {
      table_of(scores, "strongest_deg", "Strongest light, degrees from the nearest true one", 1, kOurSettings),
      agreement_table(scores),
      table_by_group(scores, "strongest_deg", "expression", "Strongest light by expression", 1, kOurSettings)};
  if (scores.groups().contains("ethnicity"))
    section.tables.push_back(without_lone_intervals(
        table_by_group(scores, "strongest_deg", "ethnicity", "Strongest light by ethnicity", 1, kOurSettings),
        scores.labels("ethnicity"), london));
  section.plots = {within_error(scores, "strongest_deg", "Photos within an error of the strongest light"),
                   within_error(scores, "recall_deg", "Photos within a mean error over the three lights")};
  return section;
}

}  // namespace

Sections direction_sections(const PaperPlan& plan) {
  const std::filesystem::path yale = plan.data / "real" / "yaleB";
  const std::filesystem::path portraits = plan.data / "real" / "portraits" / "london";
  std::vector<YalePicture> pictures;
  LondonSet london;
  if (std::filesystem::is_directory(yale)) pictures = yale_pictures(yale, plan.direction_step());
  if (std::filesystem::is_directory(portraits)) london = read_london(portraits, plan.direction_step());
  const int total = static_cast<int>(pictures.size() + 2 * london.people.size());
  int done = 0;
  const PhotoDone tell = [&] {
    if (plan.progress) plan.progress(++done, total);
  };
  return {yale_section(pictures, plan, tell), london_section(london, plan, tell)};
}

}  // namespace faceprobe::cli
