#include "faceprobe/core/resample.h"
#include "faceprobe/io/text.h"
#include "paper/objects.h"
#include "paper/plan.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::cli {

namespace {

using eval::Better;

constexpr int kCellPx = 240;  // longer side of a picture
constexpr int kTitlePx = 24;  // height of the columns' titles
constexpr int kTitleFontPx = 15;
constexpr std::size_t kColumns = 2 + kObjectSeparators.size();  // picture, truth, separators

// Code values as they are: the pictures of this section are the files' own numbers.
ByteImage small_codes(const Image& values, float gain) {
  const Image small = resampled(values, shrunk(values.width(), values.height(), kCellPx));
  ByteImage codes(small.width(), small.height(), 3);
  for (std::size_t i = 0; i < small.values().size(); ++i)
    codes.values()[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(gain * small.values()[i], 0.0F, 1.0F)));
  return codes;
}

using SheetRow = std::array<ByteImage, kColumns>;

SheetRow sheet_row(const ObjectLayers& layers) {
  SheetRow row = {small_codes(layers.picture, 1), small_codes(layers.highlight, 2)};
  for (std::size_t k = 0; k < kObjectSeparators.size(); ++k) row[2 + k] = small_codes(layers.found_highlights[k], 2);
  return row;
}

ByteImage objects_sheet(const std::vector<SheetRow>& rows) {
  int height = kTitlePx;
  for (const SheetRow& row : rows) height += row[0].height();
  ByteImage sheet(static_cast<int>(kColumns) * kCellPx, height, 3);
  std::vector<std::string> titles = {"picture", "true highlights"};
  for (const highlight::Separator separator : kObjectSeparators) titles.emplace_back(separator_name(separator));
  for (std::size_t c = 0; c < kColumns; ++c) {
    const int left = static_cast<int>(c) * kCellPx;
    io::draw_text(sheet, left + 6, kTitlePx - 7, titles[c], kTitleFontPx, {255, 255, 255});
    int top = kTitlePx;
    for (const SheetRow& row : rows) {
      for (int y = 0; y < row[c].height(); ++y) {
        const auto line = row[c].row(y);
        std::copy(line.begin(), line.end(), sheet.pixel(left, top + y));
      }
      top += row[c].height();
    }
  }
  return sheet;
}

// One picture a column, and their mean; after each separator its published figures where the set has them.
eval::ReportTable object_table(const eval::ScoreTable& scores, const std::string& set, const std::string& metric,
                               const std::string& title, int decimals, Better better) {
  eval::ReportTable table{.title = title + ": " + (set == "shen" ? "Shen & Zheng's objects" : "Grosse's objects"),
                          .columns = {}};
  std::map<std::string, std::size_t> column;
  for (const eval::ScoreRow& row : scores.rows()) {
    if (row.groups.at("set") != set || !column.emplace(row.groups.at("picture"), column.size()).second) continue;
    table.columns.push_back(row.groups.at("picture"));
  }
  table.columns.emplace_back("mean");
  table.decimals.assign(table.columns.size(), decimals);
  table.better.assign(table.columns.size(), better);
  const auto add = [&](const std::string& name, const std::string& method, const std::string& of) {
    eval::ReportTable::Row line{.name = name};
    line.values.resize(table.columns.size());
    for (const eval::ScoreRow& row : scores.rows()) {
      if (row.method == method && row.groups.at("set") == set && row.metrics.contains(of))
        line.values[column.at(row.groups.at("picture"))] = row.metrics.at(of);
    }
    line.values.back() = scores.summary(of, {method, "set", set}).mean;
    if (line.values.front()) table.rows.push_back(std::move(line));
  };
  for (const std::string& method : scores.methods()) {
    add(method, method, metric);
    if (metric == "psnr_diffuse") add(method + ", published", method, "published");
  }
  return table;
}

}  // namespace

Sections object_sections(const PaperPlan& plan) {
  eval::ReportSection section{
      .id = "objects",
      .title = "Highlight layers of objects",
      .text =
          "Objects whose diffuse layer was photographed through polarisers: those of Shen & Zheng 2013 and of Grosse "
          "et "
          "al. 2009 (MIT). Code values are taken as they are, as in the published figures, which are those of the SIHR "
          "collection: they tell whether our classical separators do what theirs do. Everything counts, the "
          "background too. The black layer takes the whole picture for diffuse.\n\n"
          "Our network needs a face and has no row here.",
      .command = "bench_separation --data DIR"};
  const std::filesystem::path folder = plan.data / "real" / "specsep_objects";
  const std::vector<ObjectPicture> pictures = object_pictures(folder);
  for (const std::string set : kObjectSets) {
    const bool known = std::any_of(pictures.begin(), pictures.end(), [&](const auto& of) { return of.set == set; });
    if (known) continue;
    section.missing += std::string(section.missing.empty() ? "" : " ") + "There is no real/specsep_objects/" + set +
                       " in the data folder; docs/data.md says what belongs there.";
  }
  if (pictures.empty()) return {section};
  std::vector<SheetRow> rows;
  int done = 0;
  const auto visit = [&](const ObjectPicture&, const ObjectLayers& layers) {
    if (static_cast<int>(rows.size()) < plan.picture_rows()) rows.push_back(sheet_row(layers));
    if (plan.progress) plan.progress(++done, static_cast<int>(pictures.size()));
  };
  const eval::ScoreTable scores = measure_objects(pictures, {.threads = plan.threads, .visit = visit});
  for (const std::string set : kObjectSets) {
    if (scores.known_values("psnr_diffuse", {.group = "set", .label = set}).empty()) continue;
    section.tables.push_back(
        object_table(scores, set, "psnr_diffuse", "PSNR of the diffuse layer, dB", 1, Better::kHigher));
    section.tables.push_back(
        object_table(scores, set, "rmse_highlight", "RMSE of the highlight layer, 0-255", 2, Better::kLower));
    section.tables.push_back(
        object_table(scores, set, "ssim_highlight", "SSIM of the highlight layer", 3, Better::kHigher));
  }
  section.pictures = {
      {.title = "Layers",
       .caption =
           "Columns: picture, true highlight, then those of the separators. Highlights are drawn twice as bright.",
       .picture = objects_sheet(rows)}};
  return {section};
}

}  // namespace faceprobe::cli
