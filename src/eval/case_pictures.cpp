#include "eval/case_pictures.h"

#include "eval/relight_sheet.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;

constexpr int kNside = 16;
constexpr int kCellPx = 160;
constexpr float kHighlightGain = 2;

// Cases of a table, spread evenly over those that it has.
std::vector<std::string> some_cases(const ScoreTable& table, int rows) {
  std::vector<std::string> all;
  const std::vector<std::string> methods = table.methods();
  for (const ScoreRow& row : table.rows()) {
    if (row.method == methods.front()) all.push_back(row.sample);
  }
  const std::size_t taken = std::min(all.size(), static_cast<std::size_t>(rows));
  std::vector<std::string> chosen;
  for (std::size_t i = 0; i < taken; ++i) chosen.push_back(all[i * all.size() / taken]);
  return chosen;
}

// What the methods wrote, by method and case.
class Results {
 public:
  Results(const CaseScores& scores, const fs::path& work) {
    for (const ScoreRow& run : scores.runs.rows()) {
      if (!run.groups.contains("failure")) folders_[{run.method, run.sample}] = work / run.groups.at("folder") / "out";
    }
  }

  CaseResult of(const std::string& method, const Case& one) const {
    const auto folder = folders_.find({method, one.name});
    if (folder == folders_.end()) return {};
    return read_case_result(folder->second, one.photo.width(), one.photo.height());
  }

 private:
  std::map<std::pair<std::string, std::string>, fs::path> folders_;
};

// "photo, truth, a, b": the columns of a picture.
std::string columns_text(const std::string& truth, const std::vector<std::string>& methods) {
  std::string text = "Columns: photo, " + truth;
  for (const std::string& method : methods) text += ", " + method;
  return text;
}

std::string rows_text(const std::vector<std::string>& cases) {
  std::string text = " Rows: ";
  for (std::size_t i = 0; i < cases.size(); ++i) text += (i == 0 ? "" : ", ") + cases[i];
  return text + ".";
}

// In the upper left corner of a square.
void put(ByteImage& sheet, Image picture, float gain, int column, int row) {
  for (float& value : picture.values()) value = std::clamp(gain * value, 0.0F, 1.0F);
  const double scale = static_cast<double>(kCellPx) / std::max(picture.width(), picture.height());
  const ByteImage cell = encode_srgb(resampled(picture, {0, 0, scale, kCellPx, kCellPx}));
  for (int y = 0; y < kCellPx; ++y)
    std::copy_n(cell.pixel(0, y), 3 * kCellPx, sheet.pixel(column * kCellPx, row * kCellPx + y));
}

}  // namespace

ReportPicture light_picture(const CaseScores& scores, const CaseReport& options) {
  const std::vector<std::string> methods = scores.light.methods();
  if (methods.empty() || options.rows == 0) return {};
  const std::vector<std::string> cases = some_cases(scores.light, options.rows);
  const LitObject object = options.draw();
  const SphereGrid grid(kNside);
  RelightSheet sheet(object, grid, static_cast<int>(cases.size()), static_cast<int>(methods.size()));
  const Results results(scores, options.work);
  for (const std::string& name : cases) {
    const Case one = read_case(options.data / name);
    if (!one.light)
      throw Error(ExitCode::kInput, (options.data / name).string() + " has lost its light. Measure the cases again.");
    sheet.begin_row(one.photo, grid_from_env_map(*one.light, grid));
    for (const std::string& method : methods) {
      const CaseResult result = results.of(method, one);
      sheet.add(result.light ? grid_from_env_map(*result.light, grid) : Eigen::MatrixX3f());
    }
  }
  return {.title = "Objects and maps",
          .caption = columns_text("true light", methods) +
                     ". Above the object in each light, below the map; a cell is black where there is no result." +
                     rows_text(cases),
          .picture = sheet.picture()};
}

ReportPicture highlight_picture(const CaseScores& scores, const CaseReport& options) {
  const std::vector<std::string> methods = scores.highlight.methods();
  if (methods.empty() || options.rows == 0) return {};
  const std::vector<std::string> cases = some_cases(scores.highlight, options.rows);
  ByteImage sheet(static_cast<int>(methods.size() + 2) * kCellPx, static_cast<int>(cases.size()) * kCellPx, 3);
  const Results results(scores, options.work);
  for (std::size_t r = 0; r < cases.size(); ++r) {
    const Case one = read_case(options.data / cases[r]);
    const int row = static_cast<int>(r);
    put(sheet, decode_srgb(one.photo), 1, 0, row);
    if (!one.highlight.empty()) put(sheet, one.highlight, kHighlightGain, 1, row);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      CaseResult result = results.of(methods[m], one);
      if (!result.highlight.empty())
        put(sheet, std::move(result.highlight), kHighlightGain, static_cast<int>(m) + 2, row);
    }
  }
  return {.title = "Layers",
          .caption = columns_text("true highlights", methods) +
                     ". Highlights are drawn twice as bright; a cell is black where there is no result." +
                     rows_text(cases),
          .picture = std::move(sheet)};
}

}  // namespace faceprobe::eval
