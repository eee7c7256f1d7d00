#include "faceprobe/core/error.h"
#include "paper/derived_tables.h"
#include "paper/directions.h"
#include "paper/london.h"
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

const std::set<std::string> kOurSettings = {"transport, net", "normals of the net"};
constexpr const char* kLamp = "single lamp by least squares";

// Of each source of normals, with the light prior and, where `both`, without it.
std::vector<DirectionSetting> settings_by_normals(const DirectionRows& rows, bool both) {
  std::vector<DirectionSetting> settings;
  for (const pipeline::NormalSource normals : rows.normals) {
    settings.push_back(normals_setting(normals, rows.base));
    if (!both) continue;
    settings.push_back(settings.back());
    settings.back().name += ", without the prior";
    settings.back().options.prior = pipeline::PriorSource::kSmooth;
  }
  return settings;
}

// The single lamp as a method of its own beside the settings' main lights: named after the setting for each of `lamp_of`, or if that is one alone by itself.
eval::ScoreTable main_lights_and_lamp(const eval::ScoreTable& scores, const std::set<std::string>& lamp_of) {
  eval::ScoreTable rows;
  rows.order_labels("flash", yale_flash_labels());
  for (const eval::ScoreRow& row : scores.rows()) {
    rows.add({row.method, row.sample, row.groups, {{"deg", row.metrics.at("main_light_deg")}}, row.person});
    if (!lamp_of.contains(row.method)) continue;
    const std::string name = lamp_of.size() > 1 ? kLamp + (", " + row.method) : std::string(kLamp);
    rows.add({name, row.sample, row.groups, {{"deg", row.metrics.at("lamp_deg")}}, row.person});
  }
  return rows;
}

std::string command_of(const DirectionRows& rows, const std::string& set) {
  std::string command = "faceprobe eval direction --data DIR --set " + set + " --every " + std::to_string(rows.every);
  for (std::size_t i = 0; i < rows.normals.size(); ++i)
    command += (i == 0 ? " --normals " : ",") + std::string(normals_option(rows.normals[i]));
  return command;
}

// What a reader has to know of the rows by normals.
constexpr const char* kByNormals =
    "\n\nRows are our estimate with its normals from the mesh, from the network, or from a head model that is fitted "
    "to "
    "the landmarks. The light prior learnt from observations with the network's normals, which favours them; rows "
    "without it start from a smooth fit to the shading.";

eval::ReportPlot within_error(const eval::ScoreTable& scores, const std::string& metric, const std::string& title) {
  eval::ReportPlot plot = cumulative_of(scores, metric, title, "degrees", kOurSettings);
  plot.y_label = "share of the photos";
  plot.missing_are_largest = true;
  return plot;
}

struct YaleRows {
  std::vector<DirectionSetting> settings;
  std::set<std::string> lamp_of;  // the settings whose single lamp is told
};

// The crops are too tight for the prior to be asked.
YaleRows yale_rows(const DirectionRows& rows) {
  YaleRows yale;
  if (!rows.normals.empty()) {
    yale.settings = settings_by_normals(rows, false);
    for (const DirectionSetting& setting : yale.settings) yale.lamp_of.insert(setting.name);
    return yale;
  }
  yale.settings = {direction_setting(Solver::kTransport, {}, rows.base),
                   direction_setting(Solver::kTransport, Separator::kYang, rows.base),
                   direction_setting(Solver::kPaper, {}, rows.base)};
  yale.settings[1].name = "transport, classical";
  yale.lamp_of = {yale.settings[1].name};
  if (rows.changed) {
    yale.settings.push_back(direction_setting(Solver::kTransport, {}, rows.base));
    yale.settings.back().name += ", codes taken for sRGB";
    yale.settings.back().linear_codes = false;
  }
  return yale;
}

eval::ReportSection yale_section(const std::vector<YalePicture>& pictures, const DirectionRows& rows,
                                 const PhotoDone& done) {
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
      .command = command_of(rows, "yale")};
  if (pictures.empty()) {
    section.missing = "There are no pictures in real/yaleB of the data folder; docs/data.md says what belongs there.";
    return section;
  }
  std::set<std::filesystem::path> people;  // a folder each
  for (const YalePicture& picture : pictures) people.insert(picture.file.parent_path());
  section.text +=
      "\n\nThese are " + std::to_string(pictures.size()) + " pictures of " + std::to_string(people.size()) + " people.";
  const YaleRows yale = yale_rows(rows);
  const bool usual = rows.normals.empty();
  if (usual) section.missing = rows.rivals.missing;
  if (!usual) section.text += kByNormals;
  const eval::ScoreTable scores =
      measure_yale(pictures, yale.settings, done, usual ? rows.rivals.methods : std::vector<FaceLightMethod>());
  const eval::ScoreTable main_light = main_lights_and_lamp(scores, yale.lamp_of);
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

std::filesystem::path yale_folder(const std::filesystem::path& data) { return data / "real" / "yaleB"; }

std::filesystem::path london_folder(const std::filesystem::path& data) {
  return data / "real" / "portraits" / "london";
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

std::vector<DirectionSetting> london_settings(const DirectionRows& rows) {
  if (!rows.normals.empty()) return settings_by_normals(rows, true);
  std::vector<DirectionSetting> settings = {direction_setting(Solver::kTransport, {}, rows.base),
                                            direction_setting(Solver::kTransport, Separator::kYang, rows.base),
                                            direction_setting(Solver::kTransport, Separator::kTan, rows.base),
                                            direction_setting(Solver::kTransport, Separator::kShen, rows.base),
                                            direction_setting(Solver::kPaper, {}, rows.base)};
  if (rows.changed) {
    settings.push_back(direction_setting(Solver::kTransport, {}, rows.base));
    settings.back().name += ", without the prior";
    settings.back().options.prior = pipeline::PriorSource::kSmooth;
  }
  return settings;
}

eval::ReportSection london_section(const LondonSet& london, const DirectionRows& rows, const PhotoDone& done) {
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
      .command = command_of(rows, "london")};
  if (london.people.empty()) {
    section.missing =
        "There are no people with two photos in real/portraits/london of the data folder; docs/data.md says what "
        "belongs there.";
    return section;
  }
  const bool usual = rows.normals.empty();
  if (usual) section.missing = rows.rivals.missing;
  if (!usual) section.text += kByNormals;
  const eval::ScoreTable scores =
      measure_london(london, london_settings(rows), done, usual ? rows.rivals.methods : std::vector<FaceLightMethod>());
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

bool has_directions(const std::filesystem::path& data) {
  return std::filesystem::is_directory(yale_folder(data)) || std::filesystem::is_directory(london_folder(data));
}

Sections measure_directions(const DirectionRows& rows) {
  if (rows.every < 1)
    throw Error(ExitCode::kUsage, "every is " + std::to_string(rows.every) + "; it is 1 for all photos, or more.");
  std::vector<YalePicture> pictures;
  LondonSet london;
  if (rows.yale && std::filesystem::is_directory(yale_folder(rows.data)))
    pictures = yale_pictures(yale_folder(rows.data), rows.every);
  if (rows.london && std::filesystem::is_directory(london_folder(rows.data)))
    london = read_london(london_folder(rows.data), rows.every);
  const int total = static_cast<int>(pictures.size() + 2 * london.people.size());
  int done = 0;
  const PhotoDone tell = [&] {
    if (rows.progress) rows.progress(++done, total);
  };
  Sections sections;
  if (rows.yale) sections.push_back(yale_section(pictures, rows, tell));
  if (rows.london) sections.push_back(london_section(london, rows, tell));
  return sections;
}

}  // namespace faceprobe::cli
