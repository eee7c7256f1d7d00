#include "faceprobe/eval/case_benchmark.h"

#include "eval/case_fixtures.h"
#include "eval/small_faces.h"
#include "faceprobe/eval/case_export.h"
#include "faceprobe/io/picture_file.h"
#include "support/expect_error.h"

#include <map>
#include <set>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;
using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

// Writes the truth, counts its calls.
CaseMethod copying(std::map<std::string, int>& calls, const std::string& identity = "copy 1") {
  return {
      "copy", identity, [&calls](const CaseRunPaths& paths) {
        ++calls[paths.data.filename().string()];
        for (const auto& [from, to] : {std::pair("gt.hdr", "map.hdr"), std::pair("highlight.exr", "highlight.exr")}) {
          if (fs::exists(paths.data / from)) fs::copy_file(paths.data / from, paths.out / to);
        }
        return std::string();
      }};
}

CaseMethod failing(const std::string& reason) {
  return {"fails", "fails", [reason](const CaseRunPaths&) { return reason; }};
}

Case unlit_case() {
  Case one = fixtures::whole_case();
  one.light.reset();
  return one;
}

// Two cases: one with all, one with its light alone; or both without, which are measured at once.
struct TwoCases {
  explicit TwoCases(bool with_light = true) {
    Case lit = with_light ? fixtures::whole_case() : unlit_case();
    write_case(data() / "a", lit);
    if (with_light) lit.highlight = Image();
    lit.groups["scene"] = "outdoor";
    write_case(data() / "b", lit);
  }
  fs::path data() const { return folder / "cases"; }
  CaseBenchmark options() const {
    return {.work = folder / "work", .object = [] { return LitObject(sphere_mesh(16), {.size_px = 16}); }};
  }

  TempFolder folder;
};

TEST(CaseBenchmark, TheTruthHasNoErrorAndWhatFailedIsMissing) {
  const TwoCases two;
  std::map<std::string, int> calls;
  const CaseScores scores =
      measure_cases(two.data(), {copying(calls), ambient_case_method(), failing("exit code 3")}, two.options());
  EXPECT_EQ(scores.cases, 2);
  EXPECT_EQ(scores.known, 2);
  for (const char* metric : {"diffuse", "glossy", "si_mirror", "nrmse_map", "colour", "main_light"}) {
    const Summary copy = scores.light.summary(metric, {.method = "copy"});
    EXPECT_EQ(copy.count, 2U) << metric;
    EXPECT_NEAR(copy.mean, 0, 1e-3) << metric;  // float rounding
    EXPECT_EQ(scores.light.summary(metric, {.method = "fails"}).missing, 2U) << metric;
  }
  EXPECT_GT(scores.light.summary("diffuse", {.method = "ambient"}).mean, 20);
  // Where the layer is not known nothing is missing, and a method without layers is not there.
  EXPECT_EQ(scores.highlight.summary("rmse", {.method = "copy"}).count, 1U);
  EXPECT_EQ(scores.highlight.summary("rmse", {.method = "copy"}).missing, 0U);
  EXPECT_EQ(scores.highlight.summary("rmse", {.method = "copy"}).mean, 0);
  EXPECT_NEAR(scores.highlight.summary("ssim", {.method = "copy"}).mean, 1, 1e-9);
  EXPECT_EQ(scores.highlight.summary("rmse", {.method = "fails"}).missing, 1U);
  EXPECT_EQ(scores.highlight.methods(), (std::vector<std::string>{"copy", "fails"}));
  EXPECT_EQ(scores.light.labels("scene"), (std::vector<std::string>{"indoor", "outdoor"}));
  EXPECT_EQ(scores.light.labels("light"), std::vector<std::string>{"one lamp"});
  EXPECT_EQ(scores.light.labels("failure"), std::vector<std::string>{"exit code 3"});
  ASSERT_EQ(scores.failures.size(), 2U);
  EXPECT_EQ(scores.failures[1].sample, "b");
  EXPECT_NE(scores.missing_markdown().find("| fails | b | exit code 3 |"), std::string::npos);
}

TEST(CaseBenchmark, HighlightsAreJudgedInTheMaskAlone) {
  const TwoCases two;
  Case one = fixtures::whole_case();
  for (int y = 0; y < one.mask.height(); ++y) {
    for (int x = 0; x < one.mask.width(); ++x) one.mask(x, y) = x < 8 ? 255 : 0;
  }
  write_case(two.data() / "a", one);
  const CaseMethod method{"half", "half", [&one](const CaseRunPaths& paths) {
                            Image found = one.highlight;
                            for (int y = 0; y < found.height(); ++y) {
                              for (int x = 0; x < found.width(); ++x) found(x, y, 0) += x < 8 ? 0.1F : 0.5F;
                            }
                            io::write_picture(paths.out / "highlight.exr", found, {}, false);
                            return std::string();
                          }};
  const CaseScores scores = measure_cases(two.data(), {method}, two.options());
  // 25.5 in one channel of three; the truth is stored in half floats.
  EXPECT_NEAR(scores.highlight.summary("rmse").mean, 25.5 / std::sqrt(3.0), 0.02);
}

TEST(CaseBenchmark, CasesSayWhomTheyShow) {
  const TwoCases two;
  for (const char* name : {"a", "b"}) {
    Case one = read_case(two.data() / name);
    one.groups["person"] = "ann";
    write_case(two.data() / name, one);
  }
  const CaseScores scores = measure_cases(two.data(), {ambient_case_method()}, two.options());
  EXPECT_EQ(scores.light.summary("diffuse").count, 2U);
  EXPECT_EQ(scores.light.summary("diffuse").people, 1U);
  EXPECT_FALSE(scores.light.groups().contains("person"));  // no table by person
}

TEST(CaseBenchmark, WhatIsKnownIsNotRunAgain) {
  const TwoCases two(false);
  std::map<std::string, int> calls;
  const CaseScores first = measure_cases(two.data(), {copying(calls)}, two.options());
  const CaseScores again = measure_cases(two.data(), {copying(calls)}, two.options());
  EXPECT_EQ(calls["a"], 1);
  EXPECT_EQ(calls["b"], 1);
  EXPECT_EQ(again.highlight.csv(), first.highlight.csv());
  EXPECT_EQ(again.runs.csv(), first.runs.csv());  // seconds, too
  // Another name for the same contents, a new case, a case that changed.
  fs::rename(two.data() / "a", two.data() / "c");
  Case changed = unlit_case();
  changed.photo(0, 0) = 1;
  write_case(two.data() / "b", changed);
  write_case(two.data() / "d", unlit_case());  // as c
  measure_cases(two.data(), {copying(calls)}, two.options());
  EXPECT_EQ(calls["b"], 2);
  EXPECT_EQ(calls["c"], 0);
  EXPECT_EQ(calls["d"], 0);
  // Another command.
  measure_cases(two.data(), {copying(calls, "copy 2")}, two.options());
  EXPECT_EQ(calls["b"], 3);
}

TEST(CaseBenchmark, WhatIsDamagedOrFailedIsRunAgain) {
  const TwoCases two(false);
  std::map<std::string, int> calls;
  const CaseScores first = measure_cases(two.data(), {copying(calls)}, two.options());
  for (const auto& file : fs::recursive_directory_iterator(two.folder / "work")) {
    if (file.path().filename() == "highlight.exr") fixtures::write_bytes(file.path(), "no picture any more");
  }
  const CaseScores again = measure_cases(two.data(), {copying(calls)}, two.options());
  EXPECT_EQ(calls["a"], 2);
  EXPECT_EQ(again.highlight.csv(), first.highlight.csv());
  int tries = 0;
  const CaseMethod late{"late", "late", [&](const CaseRunPaths& paths) {
                          EXPECT_TRUE(fs::is_empty(paths.out));  // nothing of the try before
                          fixtures::write_bytes(paths.out / "map.hdr",
                                                ++tries < 3 ? "no map" : fixtures::hdr_with_lamp(8, 4, 1, 1));
                          return std::string();
                        }};
  EXPECT_EQ(measure_cases(two.data(), {late}, two.options()).failures.size(), 2U);
  EXPECT_EQ(measure_cases(two.data(), {late}, two.options()).failures.size(), 0U);
  EXPECT_EQ(tries, 4);
}

TEST(CaseBenchmark, FiguresAreKeptAsLongAsTheScoringIsTheSame) {
  const TwoCases two;
  std::map<std::string, int> calls;
  int objects = 0;
  CaseBenchmark options = two.options();
  options.object = [&objects] {
    ++objects;
    return LitObject(sphere_mesh(16), {.size_px = 16});
  };
  options.scoring = "a";
  const CaseScores first = measure_cases(two.data(), {copying(calls), ambient_case_method()}, options);
  EXPECT_EQ(objects, 1);
  const CaseScores again = measure_cases(two.data(), {copying(calls), ambient_case_method()}, options);
  EXPECT_EQ(objects, 1);
  EXPECT_EQ(again.light.csv(), first.light.csv());
  EXPECT_EQ(again.highlight.csv(), first.highlight.csv());
  EXPECT_EQ(again.runs.csv(), first.runs.csv());
  options.scoring = "b";
  measure_cases(two.data(), {copying(calls)}, options);
  EXPECT_EQ(objects, 2);
  EXPECT_EQ(calls["a"], 1);  // what it wrote is still there
  // What fails is measured against nothing, and not kept.
  measure_cases(two.data(), {failing("exit code 3")}, options);
  EXPECT_EQ(measure_cases(two.data(), {failing("exit code 3")}, options).failures.size(), 2U);
}

TEST(CaseBenchmark, LooksAtAllCasesBeforeItRunsAny) {
  const TwoCases two;
  std::map<std::string, int> calls;
  const auto refused = [&](const std::vector<std::string>& says) {
    expect_error(ExitCode::kInput, says, [&] { measure_cases(two.data(), {copying(calls)}, two.options()); });
    EXPECT_TRUE(calls.empty());
  };
  fixtures::write_bytes(two.data() / "b/case.json", "{\"groups\": {\"diffuse\": \"a\"}}");
  refused({"b/case.json", "'diffuse'"});
  fixtures::write_bytes(two.data() / "b/case.json", "{\"groups\": {\"failure\": \"a\"}}");
  refused({"b/case.json", "'failure'"});
  fixtures::write_bytes(two.data() / "b/gt.hdr", "no map");
  refused({"b/gt.hdr"});
  fs::create_directory(two.data() / "c");
  fs::remove_all(two.data() / "b");
  refused({"c/photo.png is missing"});
}

TEST(CaseBenchmark, AGroupHasNoColumnsName) {
  const TwoCases two;
  const CaseScores scores = measure_cases(two.data(), {ambient_case_method(), failing("no")}, two.options());
  std::set<std::string> columns = scores.light.metrics();
  columns.insert(scores.highlight.metrics().begin(), scores.highlight.metrics().end());
  EXPECT_EQ(columns.size(), 17U);  // of the two tables
  columns.insert({"light", "failure"});
  for (const std::string& column : columns) {
    fixtures::write_bytes(two.data() / "b/case.json", "{\"groups\": {\"" + column + "\": \"a\"}}");
    expect_error(ExitCode::kInput, {"b/case.json", "'" + column + "'"},
                 [&] { measure_cases(two.data(), {}, two.options()); });
  }
}

TEST(CaseBenchmark, TakesCasesEvenly) {
  const TwoCases two;
  for (const char* name : {"c", "d"}) write_case(two.data() / name, fixtures::whole_case());
  CaseBenchmark options = two.options();
  options.samples = 2;
  const CaseScores scores = measure_cases(two.data(), {ambient_case_method()}, options);
  EXPECT_EQ(scores.cases, 2);
  EXPECT_EQ(scores.known, 4);
  EXPECT_EQ(scores.runs.rows()[1].sample, "c");
  options.samples = 0;
  expect_error(ExitCode::kUsage, {"samples is 0"}, [&] { measure_cases(two.data(), {}, options); });
  expect_error(ExitCode::kUsage, {"No folder"}, [&] { measure_cases(two.data(), {}, {}); });
}

TEST(CaseExport, PhotosBecomeCasesWithTheirTruths) {
  SmallFaces small;
  // The same faces where they can be: a metre before the camera.
  small.view.faces[0].camera_from_head.translation() = Eigen::Vector3f(0, 0, -1);
  const fs::path data = small.folder / "posed";
  const synth::ShardWriter writer(data, {.size_px = SmallFaces::kSize, .environment_height = 16, .recipe = "{}"});
  writer.write(0, std::vector<synth::ViewSamples>{{small.view, {small.truth, small.truth, small.truth}}});
  writer.finish(1, "");
  const synth::ShardReader faces(data);
  const fs::path cases = small.folder / "cases";
  EXPECT_EQ(
      export_cases(faces, cases, {.samples = 2, .scene = [](int) { return std::string("indoor"); }, .licence = "CC0"}),
      2);
  EXPECT_EQ(case_folders(cases), (std::vector<fs::path>{cases / "000000", cases / "000002"}));
  const Case one = read_case(cases / "000000");
  EXPECT_EQ(one.photo, small.truth.photo);
  EXPECT_EQ(one.groups.at("scene"), "indoor");
  EXPECT_TRUE(one.groups.contains("tone"));
  EXPECT_EQ(one.groups.at("person"), read_case(cases / "000002").groups.at("person"));
  EXPECT_EQ(one.licence, "CC0");
  // In the middle of the ball, which looks at the camera. Half floats; RGBE for the map.
  EXPECT_EQ(one.mask(16, 16), 255);
  EXPECT_EQ(one.mask(0, 0), 0);
  EXPECT_NEAR(one.normal_cam(16, 16, 2), 1, 2e-3);
  EXPECT_EQ(one.normal_cam(0, 0, 2), 0);
  EXPECT_LT(one.normal_cam(8, 16, 0), -0.5F);       // what is at the left looks to the left
  EXPECT_NEAR(one.diffuse(16, 16, 0), 0.6F, 5e-3);  // and eight bits of the photo
  EXPECT_EQ(one.highlight(16, 16, 0), 0);
  ASSERT_TRUE(one.light);
  EXPECT_NEAR(one.light->radiance()(16, 8, 0), 20, 20.0 / 128);
  ASSERT_TRUE(one.pose);
  EXPECT_EQ(one.pose->camera.focal_px, 60);
  EXPECT_EQ(one.pose->camera_from_head.translation(), Eigen::Vector3d(0, 0, -1));
  // Heads that nobody posed have none.
  export_cases(synth::ShardReader(small.path()), small.folder / "unposed", {.samples = 1});
  EXPECT_FALSE(read_case(small.folder / "unposed/000000").pose);
  expect_error(ExitCode::kUsage, {"samples is 0"}, [&] { export_cases(faces, cases, {.samples = 0}); });
}

}  // namespace
}  // namespace faceprobe::eval
