#include "faceprobe/eval/earlier_rows.h"

#include "faceprobe/eval/paired_column.h"

#include <gtest/gtest.h>

namespace faceprobe::eval {
namespace {

PaperReport report_with(std::vector<ReportTable::Row> rows, std::string missing = {}) {
  ReportTable table{.title = "RMSE", .columns = {"mean", "n"}, .rows = std::move(rows)};
  return {.title = "Report",
          .sections = {
              {.id = "light", .title = "Light", .text = "Photos.", .tables = {table}, .missing = std::move(missing)}}};
}

const ReportTable::Row kEmpty{.name = "ambient", .values = {133.4, 100}, .intervals = {std::pair(125.0, 141.0)}};

TEST(EarlierRows, AreAddedWhereACommonRowIsTheSame) {
  PaperReport now = report_with({{.name = "net", .values = {20, 100}, .ours = true}, kEmpty},
                                "No row of rival, small: its weights, r.safetensors, are not there. No row of other: "
                                "why. Scenes are not told apart.");
  const PaperReport before = report_with({{.name = "net", .values = {32, 100}, .ours = true},
                                          kEmpty,
                                          {.name = "rival, small", .values = {45, 99}, .note = "1 missing"}});
  EXPECT_EQ(add_earlier_rows(now, before), std::set<std::string>{"rival, small"});
  const ReportSection& section = now.sections[0];
  ASSERT_EQ(section.tables[0].rows.size(), 3U);
  EXPECT_EQ(section.tables[0].rows[0].values[0], 20);  // its own figure stays
  EXPECT_EQ(section.tables[0].rows[2].values[0], 45);
  EXPECT_EQ(section.tables[0].rows[2].note, "1 missing, earlier");
  EXPECT_EQ(section.missing, "No row of other: why. Scenes are not told apart.");
  EXPECT_NE(section.text.find("earlier version: rival, small."), std::string::npos);
  // Once more changes nothing.
  const PaperReport once = now;
  EXPECT_TRUE(add_earlier_rows(now, before).empty());
  EXPECT_EQ(now, once);
}

TEST(EarlierRows, AreNotTakenFromOtherPhotos) {
  ReportTable::Row other = kEmpty;
  other.values[0] = 133.5;
  PaperReport now = report_with({{.name = "net", .values = {20, 100}}, other});
  const PaperReport same = now;
  EXPECT_TRUE(add_earlier_rows(now, report_with({kEmpty, {.name = "rival", .values = {45, 100}}})).empty());
  EXPECT_EQ(now, same);
  // Rows without values, and tables without a common row, prove nothing.
  PaperReport silent = report_with({{.name = "ambient", .values = {std::nullopt, 0}}});
  EXPECT_TRUE(add_earlier_rows(silent, report_with({{.name = "ambient", .values = {std::nullopt, 0}},
                                                    {.name = "rival", .values = {45, 100}}}))
                  .empty());
}

TEST(EarlierRows, StayMissingWhereATableDoesNotTakeThem) {
  const std::string missing = "No row of rival: its weights are not there.";
  PaperReport now = report_with({kEmpty}, missing);
  PaperReport before = report_with({kEmpty, {.name = "rival", .values = {45, 100}}});
  for (PaperReport* report : {&now, &before}) {
    report->sections[0].tables.push_back(report->sections[0].tables[0]);
    report->sections[0].tables[1].title = "On other photos";
  }
  now.sections[0].tables[1].rows[0].values[0] = 1;
  EXPECT_FALSE(add_earlier_rows(now, before).empty());
  EXPECT_EQ(now.sections[0].tables[0].rows.size(), 2U);
  EXPECT_EQ(now.sections[0].tables[1].rows.size(), 1U);
  EXPECT_EQ(now.sections[0].missing, missing);
}

// Ours was another then: so were the differences, which neither prove that the photos are others nor come along.
TEST(EarlierRows, LeaveTheirDifferencesToOursBehind) {
  PaperReport now = report_with({{.name = "net", .values = {20, 100}, .ours = true}, kEmpty});
  ReportTable& table = now.sections[0].tables[0];
  table.columns.emplace_back(kDifferenceColumn);
  table.rows[1].values.emplace_back(113.4);
  PaperReport before = report_with({{.name = "net", .values = {32, 100}, .ours = true}, kEmpty});
  ReportTable& old = before.sections[0].tables[0];
  old.columns.emplace_back(kDifferenceColumn);
  old.rows[1].values.emplace_back(101.4);
  old.rows.push_back({.name = "rival", .values = {45, 100, 13}});
  ASSERT_EQ(add_earlier_rows(now, before), std::set<std::string>{"rival"});
  EXPECT_EQ(table.rows[1].values[2], 113.4);
  EXPECT_EQ(table.rows[2].values[0], 45);
  EXPECT_FALSE(table.rows[2].values[2].has_value());
}

// As table_of(): who answers fewer photos is not the best of them, and means over what all answer hold for one set of methods.
TEST(EarlierRows, WithMissingPhotosMakeNoColumnComparable) {
  PaperReport now = report_with({kEmpty});
  ReportTable& table = now.sections[0].tables[0];
  table.columns = {"mean", "n", "mean of the 9 all have"};
  table.better = {Better::kLower, Better::kNeither, Better::kLower};
  PaperReport before = now;
  before.sections[0].tables[0].rows.push_back({.name = "rival", .values = {4, 9, 4}, .note = "1 missing"});
  ASSERT_FALSE(add_earlier_rows(now, before).empty());
  EXPECT_EQ(table.better[0], Better::kNeither);
  EXPECT_EQ(table.rows[1].values[0], 4);
  EXPECT_FALSE(table.rows[1].values[2]);
}

TEST(EarlierRows, KeepTheirMarks) {
  PaperReport now = report_with({kEmpty});
  PaperReport before = report_with({kEmpty, {.name = "told", .values = {1, 100}, .bound = true}});
  ASSERT_FALSE(add_earlier_rows(now, before).empty());
  const ReportTable::Row& told = now.sections[0].tables[0].rows[1];
  EXPECT_TRUE(told.bound);
  EXPECT_TRUE(is_earlier(told));
  EXPECT_FALSE(is_earlier(now.sections[0].tables[0].rows[0]));
}

TEST(EarlierRows, FollowTheColumnsByName) {
  PaperReport now = report_with({kEmpty});
  now.sections[0].tables[0].columns = {"n", "median", "mean"};
  now.sections[0].tables[0].rows = {{.name = "ambient", .values = {100, 135, 133.4}}};
  PaperReport before =
      report_with({kEmpty, {.name = "rival", .values = {45, 99}, .intervals = {std::pair(40.0, 50.0)}}});
  ASSERT_FALSE(add_earlier_rows(now, before).empty());
  const ReportTable::Row& rival = now.sections[0].tables[0].rows[1];
  EXPECT_EQ(rival.values[0], 99);
  EXPECT_FALSE(rival.values[1]);
  EXPECT_EQ(rival.values[2], 45);
  EXPECT_EQ(rival.intervals[2], std::pair(40.0, 50.0));
}

TEST(EarlierSections, KeepTheirOrderAndSayWhatTheyAre) {
  PaperReport now{.title = "Report", .sections = {{.id = "b", .title = "B", .text = "New."}, {.id = "d", .title = "D"}}};
  const PaperReport before{
      .title = "Report",
      .sections = {{.id = "a", .title = "A", .text = "Old."}, {.id = "b", .title = "B"}, {.id = "c", .title = "C"}}};
  EXPECT_EQ(add_earlier_sections(now, before), (std::vector<std::string>{"A", "C"}));
  ASSERT_EQ(now.sections.size(), 4U);
  EXPECT_EQ(now.sections[0].text, "Old.\n\nThese figures are an earlier version's.");
  EXPECT_TRUE(is_earlier(now.sections[0]));
  EXPECT_FALSE(is_earlier(now.sections[1]));
  EXPECT_EQ(now.sections[1].text, "New.");
  EXPECT_EQ(now.sections[2].id, "c");
  EXPECT_EQ(now.sections[3].id, "d");
  // Taken twice, said once.
  PaperReport again{.title = "Report", .sections = {{.id = "b", .title = "B"}}};
  add_earlier_sections(again, now);
  EXPECT_EQ(again.sections[0].text, now.sections[0].text);
}

}  // namespace
}  // namespace faceprobe::eval
