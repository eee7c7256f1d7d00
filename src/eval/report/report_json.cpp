// The report as JSON, and a section to and from it.
#include "eval/report/picture_text.h"
#include "eval/report/svg_plot.h"
#include "eval/report/table_cells.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/paper_report.h"
#include "faceprobe/io/picture_file.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace faceprobe::eval {
namespace {

using Json = nlohmann::ordered_json;
using Interval = std::optional<std::pair<double, double>>;

constexpr char kSectionSchema[] =
    "faceprobe-report-section-1";  // another number for every change that old readers cannot read
constexpr std::array<const char*, 3> kBetterNames = {"lower", "higher", "neither"};
constexpr std::array<const char*, 4> kKindNames = {"histogram", "cumulative", "bars", "lines"};

Json number_json(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json interval_json(const Interval& interval) {
  if (!interval || !std::isfinite(interval->first) || !std::isfinite(interval->second)) return nullptr;
  return {interval->first, interval->second};
}

Json numbers_json(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(number_json(value));
  return out;
}

Json intervals_json(const std::vector<Interval>& intervals) {
  Json out = Json::array();
  for (const Interval& interval : intervals) out.push_back(interval_json(interval));
  return out;
}

Json table_json(const ReportTable& table) {
  table_cells(table);  // refuses what does not fit
  Json better = Json::array();
  for (const Better b : table.better) better.push_back(kBetterNames.at(static_cast<std::size_t>(b)));
  Json rows = Json::array();
  for (const ReportTable::Row& row : table.rows) {
    Json values = Json::array();
    for (const std::optional<double>& value : row.values) values.push_back(number_json(value));
    rows.push_back({{"name", row.name},
                    {"ours", row.ours},
                    {"note", row.note},
                    {"bound", row.bound},
                    {"values", values},
                    {"intervals", intervals_json(row.intervals)}});
  }
  return {{"title", table.title},
          {"note", table.note},
          {"names_are", table.names_are},
          {"columns", table.columns},
          {"decimals", table.decimals},
          {"better", better},
          {"rows", rows}};
}

Json plot_json(const ReportPlot& plot) {
  check_plot(plot);
  Json series = Json::array();
  for (const ReportSeries& one : plot.series) {
    series.push_back({{"name", one.name},
                      {"ours", one.ours},
                      {"values", numbers_json(one.values)},
                      {"x", numbers_json(one.x)},
                      {"intervals", intervals_json(one.intervals)}});
  }
  return {{"title", plot.title},
          {"kind", kKindNames.at(static_cast<std::size_t>(plot.kind))},
          {"x_label", plot.x_label},
          {"y_label", plot.y_label},
          {"groups", plot.groups},
          {"x_low", number_json(plot.x_low)},
          {"x_high", number_json(plot.x_high)},
          {"missing_are_largest", plot.missing_are_largest},
          {"series", series}};
}

Json picture_json(const ReportPicture& picture, bool whole) {
  const ByteImage& p = picture.picture;
  Json out = {{"title", picture.title}, {"caption", picture.caption}, {"size_px", {p.width(), p.height()}}};
  if (!whole) return out;
  out["channels"] = p.channels();
  if (!p.empty()) out["png"] = io::png_data_uri(p);
  return out;
}

Json json_of(const ReportSection& section, bool whole_pictures) {
  Json out = {{"id", section.id},        {"title", section.title},     {"text", section.text},
              {"notes", section.notes},  {"command", section.command}, {"missing", section.missing},
              {"tables", Json::array()}, {"plots", Json::array()},     {"pictures", Json::array()}};
  for (const ReportTable& table : section.tables) out["tables"].push_back(table_json(table));
  for (const ReportPlot& plot : section.plots) out["plots"].push_back(plot_json(plot));
  for (const ReportPicture& picture : section.pictures)
    out["pictures"].push_back(picture_json(picture, whole_pictures));
  return out;
}

std::string dumped(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n'; }

std::optional<double> number_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<double>();
}

std::vector<double> numbers_of(const Json& json) {
  std::vector<double> out;
  for (const Json& value : json) out.push_back(number_of(value).value_or(std::nan("")));
  return out;
}

std::vector<Interval> intervals_of(const Json& json) {
  std::vector<Interval> out;
  for (const Json& value : json) {
    out.push_back(value.is_null() ? Interval() : Interval({value.at(0).get<double>(), value.at(1).get<double>()}));
  }
  return out;
}

template <class Names>
std::size_t index_of(const Names& names, const std::string& name) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return i;
  }
  throw Error(ExitCode::kInput, "The section has a \"" + name + "\" that this program does not know. Measure it again.");
}

ReportTable table_from(const Json& json) {
  ReportTable out{.title = json.at("title"),
                  .note = json.at("note"),
                  .names_are = json.at("names_are"),
                  .columns = json.at("columns"),
                  .decimals = json.at("decimals")};
  for (const Json& name : json.at("better")) {
    out.better.push_back(static_cast<Better>(index_of(kBetterNames, name.get<std::string>())));
  }
  for (const Json& row : json.at("rows")) {
    ReportTable::Row one{
        .name = row.at("name"), .ours = row.at("ours"), .note = row.at("note"), .bound = row.value("bound", false)};
    for (const Json& value : row.at("values")) one.values.push_back(number_of(value));
    one.intervals = intervals_of(row.at("intervals"));
    out.rows.push_back(std::move(one));
  }
  return out;
}

ReportPlot plot_from(const Json& json) {
  ReportPlot out{.title = json.at("title"),
                 .x_label = json.at("x_label"),
                 .y_label = json.at("y_label"),
                 .kind = static_cast<PlotKind>(index_of(kKindNames, json.at("kind").get<std::string>())),
                 .groups = json.at("groups"),
                 .x_low = number_of(json.at("x_low")),
                 .x_high = number_of(json.at("x_high")),
                 .missing_are_largest = json.at("missing_are_largest")};
  for (const Json& series : json.at("series")) {
    out.series.push_back({.name = series.at("name"),
                          .values = numbers_of(series.at("values")),
                          .x = numbers_of(series.at("x")),
                          .intervals = intervals_of(series.at("intervals")),
                          .ours = series.at("ours")});
  }
  return out;
}

ReportPicture picture_from(const Json& json) {
  ReportPicture out{.title = json.at("title"), .caption = json.at("caption")};
  if (json.contains("png")) {
    out.picture = picture_of_data_uri(json.at("png").get<std::string>());
  } else {
    out.picture = ByteImage(0, 0, json.value("channels", 1));
  }
  return out;
}

ReportSection section_from(const Json& json) {
  ReportSection out{.id = json.at("id"),
                    .title = json.at("title"),
                    .text = json.at("text"),
                    .notes = json.value("notes", ""),
                    .command = json.at("command"),
                    .missing = json.at("missing")};
  for (const Json& table : json.at("tables")) out.tables.push_back(table_from(table));
  for (const Json& plot : json.at("plots")) out.plots.push_back(plot_from(plot));
  for (const Json& picture : json.at("pictures")) out.pictures.push_back(picture_from(picture));
  return out;
}

}  // namespace

std::string report_json(const PaperReport& report) {
  Json sections = Json::array();
  for (const ReportSection& section : report.sections) sections.push_back(json_of(section, false));
  Json terms = Json::array();
  for (const auto& [term, meaning] : report.terms) terms.push_back({{"term", term}, {"meaning", meaning}});
  return dumped({{"title", report.title}, {"made_with", report.made_with}, {"terms", terms}, {"sections", sections}});
}

PaperReport report_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    PaperReport report{.title = json.at("title"), .made_with = json.at("made_with")};
    for (const Json& term : json.value("terms", Json::array()))
      report.terms.emplace_back(term.at("term").get<std::string>(), term.at("meaning").get<std::string>());
    for (const Json& section : json.at("sections")) report.sections.push_back(section_from(section));
    return report;
  } catch (const Json::exception& problem) {
    throw Error(ExitCode::kInput, std::string("The report is not what faceprobe wrote: ") + problem.what() + '.');
  }
}

std::string section_json(const ReportSection& section) {
  Json out = {{"schema", kSectionSchema}};
  out.update(json_of(section, true));
  return dumped(out);
}

ReportSection section_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != kSectionSchema) {
      throw Error(ExitCode::kInput, "The section is of another version of faceprobe. Measure it again.");
    }
    return section_from(json);
  } catch (const Json::exception& problem) {
    throw Error(ExitCode::kInput,
                std::string("The section is not what faceprobe wrote: ") + problem.what() + ". Measure it again.");
  }
}

}  // namespace faceprobe::eval
