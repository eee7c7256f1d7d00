#include "faceprobe/eval/case_report.h"

#include "eval/case_fixtures.h"
#include "eval/xml_check.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <algorithm>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;
using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

constexpr int kCellPx = 160;  // of a picture of layers

CaseMethod copying() {
  return {"copy & more", "copy", [](const CaseRunPaths& paths) {
            if (fs::exists(paths.data / "gt.hdr")) fs::copy_file(paths.data / "gt.hdr", paths.out / "map.hdr");
            fs::copy_file(paths.data / "highlight.exr", paths.out / "highlight.exr");
            return std::string();
          }};
}

CaseMethod failing() {
  return {"fails", "fails", [](const CaseRunPaths&) { return std::string("exit code 3"); }};
}

LitObject small_ball() { return LitObject(sphere_mesh(16), {.size_px = 16}); }

struct Measured {
  explicit Measured(const Case& one = fixtures::whole_case()) {
    write_case(folder / "cases" / "a", one);
    Case other = one;
    other.groups["scene"] = "outdoor";
    write_case(folder / "cases" / "b", other);
    scores = measure_cases(folder / "cases", {copying(), ambient_case_method(), failing()},
                           {.work = folder / "work", .object = small_ball});
  }
  CaseReport options() const {
    return {.data = folder / "cases", .work = folder / "work", .ours = {"copy & more"}, .draw = small_ball};
  }

  TempFolder folder;
  CaseScores scores;
};

const ReportSection& section_of(const PaperReport& report, const std::string& id) {
  return *std::ranges::find_if(report.sections, [&](const ReportSection& section) { return section.id == id; });
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

// Mean of a cell's code values.
double level_of(const ByteImage& sheet, int left, int top, int width, int height) {
  double sum = 0;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) sum += sheet(x, y, 1);
  }
  return sum / (width * height);
}

TEST(CaseReport, ThePageHasEachMethodAndPicture) {
  const Measured measured;
  const PaperReport report = case_report(measured.scores, measured.options());
  const std::string html = report_html(report);
  EXPECT_EQ(testing::XmlCheck::problem(html), "");
  for (const char* name : {"copy &amp; more", "ambient", "fails"})
    EXPECT_NE(html.find("<th scope=\"row\">" + std::string(name)), std::string::npos) << name;
  EXPECT_NE(html.find("fails has no result for 2 cases: exit code 3."), std::string::npos);
  EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,"), 2U);  // objects and maps; layers
  EXPECT_GE(count_of(html, "<svg"), 4U);  // histograms of both objects and of the layers, the curve of the main light
  EXPECT_NE(html.find("Diffuse object by scene"), std::string::npos);
}

TEST(CaseReport, FiguresAreThoseOfTheScores) {
  const Measured measured;
  const PaperReport report = case_report(measured.scores, measured.options());
  const ReportTable& diffuse = section_of(report, "relighting").tables.at(0);
  ASSERT_EQ(diffuse.rows.size(), 3U);
  EXPECT_TRUE(diffuse.rows[0].ours);
  EXPECT_EQ(diffuse.rows[1].values.at(0), measured.scores.light.summary("diffuse", {.method = "ambient"}).mean);
  EXPECT_EQ(diffuse.rows[2].values.at(0), std::nullopt);
  EXPECT_EQ(section_of(report, "highlights").tables.at(0).rows.size(), 2U);  // ambient light says nothing of layers
}

TEST(CaseReport, ThePicturesShowWhatWasWritten) {
  const Measured measured;
  const PaperReport report = case_report(measured.scores, measured.options());
  const ByteImage& layers = section_of(report, "highlights").pictures.at(0).picture;
  ASSERT_EQ(layers.width(), 4 * kCellPx);  // photo, truth, copy, fails
  ASSERT_EQ(layers.height(), 2 * kCellPx);
  for (int y = 0; y < layers.height(); ++y) {
    for (int x = 0; x < kCellPx; ++x) {
      ASSERT_EQ(layers(kCellPx + x, y, 0), layers(2 * kCellPx + x, y, 0));  // a copy of the truth
      ASSERT_EQ(layers(3 * kCellPx + x, y, 0), 0);
    }
  }
  const int high = kCellPx * fixtures::kCaseHeight / fixtures::kCaseWidth;  // the photo's share of its cell
  EXPECT_NEAR(level_of(layers, 20, 20, kCellPx - 40, high - 40), 128, 1);   // away from its edges; one code of rounding
  EXPECT_GT(level_of(layers, kCellPx, 0, kCellPx, high), 20);
  const ByteImage& lights = section_of(report, "relighting").pictures.at(0).picture;
  ASSERT_EQ(lights.width(), 5 * 16);  // photo, truth, copy, ambient, fails; balls of 16 px
  ASSERT_EQ(lights.height(), 2 * 24);
  EXPECT_GT(level_of(lights, 16, 0, 16, 24), 10);
  EXPECT_NEAR(level_of(lights, 16, 0, 16, 24), level_of(lights, 32, 0, 16, 24), 0.5);  // rounding
  EXPECT_EQ(level_of(lights, 64, 0, 16, 24), 0);
}

TEST(CaseReport, WhatIsNotKnownHasNoSection) {
  Case one = fixtures::whole_case();
  one.light.reset();
  const Measured measured(one);
  CaseReport options = measured.options();
  options.rows = 0;
  const PaperReport report = case_report(measured.scores, options);
  ASSERT_EQ(report.sections.size(), 2U);
  EXPECT_EQ(report.sections[0].id, "highlights");
  EXPECT_TRUE(report.sections[0].pictures.empty());
  EXPECT_EQ(report.sections[1].id, "runs");
}

TEST(CaseReport, RefusesWhatDoesNotValidate) {
  const Measured measured;
  CaseReport options = measured.options();
  options.rows = -1;
  expect_error(ExitCode::kUsage, {"rows is -1"}, [&] { case_report(measured.scores, options); });
  expect_error(ExitCode::kUsage, {"both folders"}, [&] { case_report(measured.scores, {}); });
  fs::remove_all(measured.folder / "cases" / "a");
  expect_error(ExitCode::kInput, {"photo.png"}, [&] { case_report(measured.scores, measured.options()); });
}

}  // namespace
}  // namespace faceprobe::eval
