#include "paper/headlines.h"

#include "faceprobe/core/error.h"
#include "faceprobe/eval/earlier_rows.h"
#include "paper/report_names.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace faceprobe::cli {

namespace {

using eval::ReportTable;

struct Headline {
  const char* what;
  const char* section;
  const char* table;
  const char* column;
  int decimals;
};
constexpr std::array kHeadlines = {
    Headline{"Highlight layer of the face's skin, RMSE of 255, mean of {:.0f} synthetic faces", "highlights",
             "RMSE on the face's skin", "mean", 1},
    Headline{"Diffuse object in the light that was found, RMSE of 255, mean of {:.0f} synthetic photos", "relighting",
             "Diffuse object", "mean", 1},
    Headline{"Strongest studio light, degrees from the nearest true one, median of {:.0f} real photos",
             "direction_london", "Strongest light, degrees from the nearest true one", "median", 1},
};

// Beginnings of the names of rows that are ours by another way, and no rivals. The paper's solver and network are some.
constexpr std::array<std::string_view, 2> kNoRivals = {"transport", "net, finetuned"};

struct Place {
  const eval::ReportSection* section = nullptr;
  const ReportTable* table = nullptr;
};
Place place_of(const eval::PaperReport& report, const Headline& line) {
  for (const eval::ReportSection& section : report.sections) {
    if (section.id != line.section) continue;
    for (const ReportTable& table : section.tables) {
      if (table.title == line.table) return {&section, &table};
    }
  }
  return {};
}

// Of what all answered, where the table has that.
std::optional<double> value_of(const ReportTable& table, const ReportTable::Row& row, std::string_view column) {
  const auto common = std::find_if(table.columns.begin(), table.columns.end(), &eval::is_common_column);
  const bool replaced = column == "mean" && common != table.columns.end();
  const auto found = replaced ? common : std::find(table.columns.begin(), table.columns.end(), column);
  const auto index = static_cast<std::size_t>(found - table.columns.begin());
  return index < row.values.size() ? row.values[index] : std::nullopt;
}

bool is_rival(const ReportTable::Row& row) {
  return !row.ours && !row.bound && !is_bound(row.name) &&
         std::none_of(kNoRivals.begin(), kNoRivals.end(),
                      [&](std::string_view name) { return row.name.starts_with(name); });
}

// Empty where the report lacks one of the two.
std::string line_of(const Place& place, const Headline& line) {
  const ReportTable& table = *place.table;
  std::optional<double> ours, photos, best;
  std::string rival;
  for (const ReportTable::Row& row : table.rows) {
    const std::optional<double> value = value_of(table, row, line.column);
    if (!value) continue;
    if (row.ours && !ours) {
      ours = value;
      photos = value_of(table, row, "n");
    } else if (is_rival(row) && (!best || *value < *best)) {
      best = value;
      rival = row.name + (eval::is_earlier(row) ? ", earlier" : "");
    }
  }
  if (!ours || !best) return {};
  return fmt::format("| {}{} | {:.{}f} | {:.{}f} ({}) |\n", fmt::format(fmt::runtime(line.what), photos.value_or(0)),
                     eval::is_earlier(*place.section) ? " (both by an earlier version)" : "", *ours, line.decimals,
                     *best, line.decimals, rival);
}

}  // namespace

std::string headlines(const eval::PaperReport& report) {
  std::string lines;
  for (const Headline& line : kHeadlines) {
    if (const Place place = place_of(report, line); place.table != nullptr) lines += line_of(place, line);
  }
  if (lines.empty()) throw Error(ExitCode::kInput, "The report has none of the figures that a first page quotes.");
  return "| measured | Faceprobe | the best of the others |\n|---|---|---|\n" + lines;
}

}  // namespace faceprobe::cli
