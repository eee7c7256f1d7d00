#include "paper/report_names.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace faceprobe::cli {

namespace {

using eval::ReportTable;

struct Name {
  std::string_view before;
  std::string_view now;
};

// Of one part of a row's name; parts have commas between.
constexpr std::array kParts = {Name{"tan", "Tan & Ikeuchi 2004"}, Name{"yang", "Yang 2010"},
                               Name{"shen", "Shen & Zheng 2013"}, Name{"paper", "paper's solver"}};

constexpr std::array<std::string_view, 5> kBounds = {"truth in harmonics", "all layers and normals known",
                                                     "normals known", "layers known", "faces known"};

struct TableName {
  std::string_view section;
  std::string_view before;
  std::string_view now;
};
// As versions before this one called them: two measures had one name.
constexpr std::array kTables = {
    TableName{"objects", "PSNR of the diffuse layer, dB: shen", "PSNR of the diffuse layer, dB: Shen & Zheng's objects"},
    TableName{"objects", "RMSE of the highlight layer, 0-255: shen",
              "RMSE of the highlight layer, 0-255: Shen & Zheng's objects"},
    TableName{"objects", "SSIM of the highlight layer: shen", "SSIM of the highlight layer: Shen & Zheng's objects"},
    TableName{"objects", "PSNR of the diffuse layer, dB: mit", "PSNR of the diffuse layer, dB: Grosse's objects"},
    TableName{"objects", "RMSE of the highlight layer, 0-255: mit",
              "RMSE of the highlight layer, 0-255: Grosse's objects"},
    TableName{"objects", "SSIM of the highlight layer: mit", "SSIM of the highlight layer: Grosse's objects"},
    TableName{"maps", "Diffuse sphere", "Diffuse sphere, si-RMSE"},
    TableName{"maps", "Rough metal sphere", "Rough metal sphere, si-RMSE"},
    TableName{"maps", "Mirror sphere", "Mirror sphere, si-RMSE"},
    TableName{"maps", "Diffuse sphere, angle of its colours, degrees",
              "Diffuse sphere, angle between its colours, degrees"},
    TableName{"sun", "Centroid, degrees", "Sun (centroid of the brightest 1 %), degrees"},
    TableName{"sun", "Centroid by scene, degrees", "Sun by scene, degrees"},
    TableName{"sun", "Azimuth alone, degrees", "The sun's azimuth alone, degrees"},
    TableName{"sun", "Elevation alone, degrees", "The sun's elevation alone, degrees"},
    TableName{"direction_yale", "Centroid of the light's energy, degrees from the flash",
              "Centroid of all light above the median, degrees from the flash"},
    TableName{"direction_yale", "Centroid by the flash's degrees off the axis",
              "Centroid of all light above the median, by the flash's degrees off the axis"},
    TableName{"ablations", "Diffuse sphere by skin tone", "Diffuse sphere, RMSE of 255, by skin tone"},
    TableName{"ablations", "Diffuse sphere by turn of the head, degrees",
              "Diffuse sphere, RMSE of 255, by turn of the head, degrees"}};

std::string part_name(const std::string& part) {
  const auto* found = std::ranges::find(kParts, std::string_view(part), &Name::before);
  return found == kParts.end() ? part : std::string(found->now);
}

std::string column_name(const std::string& column) {
  if (eval::is_common_column(column)) {
    const std::size_t digits = column.find_first_of("0123456789");
    if (digits != std::string::npos) return eval::common_column(std::stoul(column.substr(digits)));
  }
  return column == "tan" || column.starts_with("tan, n = ") ? "tan skin" + column.substr(3) : column;
}

// A line without figures that names no missing answer either.
bool asked_for_nothing(const ReportTable& table, const ReportTable::Row& row) {
  const auto column = static_cast<std::size_t>(std::ranges::find(table.columns, "n") - table.columns.begin());
  return row.note.empty() && column < row.values.size() && row.values[column] == 0.0;
}

}  // namespace

std::string row_name(const std::string& method) {
  if (method == "paper") return "paper's solver on our layers";
  std::string name;
  for (std::size_t begin = 0; begin <= method.size();) {
    const std::size_t end = std::min(method.find(", ", begin), method.size());
    name += (begin == 0 ? "" : ", ") + part_name(method.substr(begin, end - begin));
    begin = end + 2;
  }
  return name;
}

bool is_bound(std::string_view row) {
  return std::ranges::any_of(kBounds, [row](std::string_view name) { return row.starts_with(name); });
}

void name_rows(eval::PaperReport& report) {
  for (eval::ReportSection& section : report.sections) {
    for (ReportTable& table : section.tables) {
      for (const TableName& name : kTables) {
        if (name.section == section.id && name.before == table.title) table.title = name.now;
      }
      for (std::string& column : table.columns) column = column_name(column);
      std::erase_if(table.rows, [&](const ReportTable::Row& row) { return asked_for_nothing(table, row); });
      for (ReportTable::Row& row : table.rows) {
        row.name = row_name(row.name);
        row.bound = is_bound(row.name);
      }
    }
    for (eval::ReportPlot& plot : section.plots) {
      for (eval::ReportSeries& series : plot.series) series.name = row_name(series.name);
    }
  }
}

}  // namespace faceprobe::cli
