#include "paper/derived_tables.h"

#include "faceprobe/eval/sun_metrics.h"
#include "paper/yale.h"

#include <gtest/gtest.h>

#include <limits>

namespace faceprobe::cli::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Values = std::vector<std::optional<double>>;

TEST(WorstOverBest, IsTheLargestMeanOverTheLeast) {
  const eval::ReportTable diffuse{.title = "d",
                                  .columns = {"light", "brown", "dark"},
                                  .rows = {{.name = "net", .values = {20, 50, 30}, .ours = true},
                                           {.name = "one", .values = {20, std::nullopt, std::nullopt}},
                                           {.name = "nothing", .values = {0, 2, 1}}}};
  const eval::ReportTable glossy{
      .title = "g", .columns = {"light", "brown"}, .rows = {{.name = "net", .values = {30, 24}}}};
  const eval::ReportTable table = worst_over_best({{"diffuse", diffuse}, {"glossy", glossy}}, "Spread");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"diffuse", "glossy"}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].values, (Values{2.5, 1.25}));
  EXPECT_TRUE(table.rows[0].ours);
  EXPECT_EQ(table.rows[1].values, (Values{std::nullopt, std::nullopt}));  // one group, and no such row
  EXPECT_FALSE(table.rows[2].values[0]);                                  // over nothing
}

TEST(SunTable, CountsWhatWasNotFoundAsFar) {
  eval::ScoreTable scores;
  int sample = 0;
  for (const double error : {3.0, 8.0, 40.0, kNan})
    scores.add({"a", std::to_string(sample++), {{"scene", "outdoor"}}, {{"sun_centroid", error}}});
  scores.add({"a", "indoor", {{"scene", "indoor"}}, {{"sun_centroid", 1.0}}});
  scores.add({"a", "soft", {{"scene", "outdoor"}}, {{"diffuse", 1.0}}});  // has no sun
  const eval::ReportTable table = sun_table(scores, "Sun", {"a"}, "scene", "outdoor");
  EXPECT_EQ(table.columns.front(), "within 5");
  ASSERT_EQ(table.rows.size(), 1U);
  // 5, 10, 15, 20, 30, 45, 90 degrees; the mark is between the ranks of 40 and 180.
  EXPECT_EQ(table.rows[0].values, (Values{25, 50, 50, 50, 50, 75, 75, 40 + 0.25 * 140, 4}));
  EXPECT_EQ(table.rows[0].note, "1 missing");
  EXPECT_TRUE(table.rows[0].ours);
  EXPECT_EQ(sun_table(scores, "Sun").rows[0].values.back(), 5);
}

TEST(SunTable, DrawsPeople) {
  // Each error twice: as photos of one person they are no more than one.
  eval::ScoreTable twice, once;
  for (int i = 0; i < 8; ++i) {
    const double error = 5.0 * (i + 1);
    const std::string name = std::to_string(i);
    once.add({"a", name, {}, {{"sun_centroid", error}}});
    for (const char* which : {" x", " y"}) twice.add({"a", name + which, {}, {{"sun_centroid", error}}, name});
  }
  const std::size_t mark = eval::SunCurve::kAnglesDeg.size();
  const auto width = [mark](const eval::ScoreTable& scores) {
    const auto interval = sun_table(scores, "Sun").rows.at(0).intervals.at(mark);
    return interval.value().second - interval.value().first;
  };
  EXPECT_NEAR(width(twice), width(once), 1e-9);  // the same draws of people have the same quartiles
  eval::ScoreTable alone;
  for (const char* sample : {"x", "y"}) alone.add({"a", sample, {}, {{"sun_centroid", 10.0}}, "ann"});
  EXPECT_FALSE(sun_table(alone, "Sun").rows.at(0).intervals.at(mark));
}

TEST(MediansByFlash, PoolThePicturesNotTheMedians) {
  const std::vector<std::string> labels = yale_flash_labels();
  eval::ScoreTable scores;
  int sample = 0;
  const auto add = [&](const std::string& method, std::size_t label, double value) {
    scores.add({method, std::to_string(sample++), {{"flash", labels[label]}}, {{"deg", value}}});
  };
  for (const double value : {1.0, 2.0, 3.0}) add("a", 0, value);
  add("a", 1, 20);
  add("a", 2, 30);
  for (const double value : {40.0, 50.0}) add("a", 3, value);
  add("b", 0, 4);
  add("b", 1, kNan);
  add("silent", 0, kNan);
  const eval::ReportTable table = medians_by_flash(scores, "deg", "Medians");
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"0 - 12", "12 - 25", "25 - 50", "50 - 77", "within 50", "all, within 77"}));
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].values, (Values{2, 20, 30, 45, 3, 20}));  // within 50: of 1, 2, 3, 20, 30
  EXPECT_EQ(table.rows[1].values[0], 4);
  EXPECT_EQ(table.rows[1].note, "1 missing");
  EXPECT_FALSE(table.rows[2].values.back());
  EXPECT_EQ(table.better[0], eval::Better::kNeither);  // b did not answer all
}

}  // namespace
}  // namespace faceprobe::cli::testing
