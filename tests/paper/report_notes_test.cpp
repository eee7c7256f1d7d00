// Reports of this version and of earlier ones under the names and warnings that a reader needs.
#include "paper/report_notes.h"

#include "paper/report_names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::cli::testing {
namespace {

using eval::Better;
using eval::ReportTable;

TEST(RowNames, AreNotTakenForOthers) {
  EXPECT_EQ(row_name("tan"), "Tan & Ikeuchi 2004");
  EXPECT_EQ(row_name("yang, published"), "Yang 2010, published");
  EXPECT_EQ(row_name("transport, shen"), "transport, Shen & Zheng 2013");
  EXPECT_EQ(row_name("paper"), "paper's solver on our layers");
  EXPECT_EQ(row_name("paper, net"), "paper's solver, net");
  EXPECT_EQ(row_name("layers of Yang's separator"), "layers of Yang's separator");
  EXPECT_EQ(row_name(""), "");
  for (const char* name : {"tan", "yang, published", "paper", "paper, net", "li 2017, lite"})
    EXPECT_EQ(row_name(row_name(name)), row_name(name));
}

TEST(RowNames, BoundsAreToldTheTruth) {
  for (const char* name : {"truth in harmonics of order 5", "all layers and normals known, without the prior",
                           "normals known", "layers known", "faces known"})
    EXPECT_TRUE(is_bound(name)) << name;
  for (const char* name : {"transport", "transport without the prior", "faces as found", "single lamp by least squares"})
    EXPECT_FALSE(is_bound(name)) << name;
}

// As versions before bounds and terms wrote it.
eval::PaperReport early_report() {
  return eval::report_from_json(R"({"title": "T",
    "made_with": "Faceprobe 0.1.0, parts relighting, directions. What else there is: Faceprobe 0.1.0. 100 photos.",
    "sections": [
      {"id": "maps", "title": "Maps", "text": "", "command": "", "missing": "", "plots": [], "pictures": [], "tables": [
        {"title": "Mirror sphere", "note": "", "names_are": "method", "columns": ["mean", "n", "mean of the 9 all have"],
         "decimals": [1, 0, 1], "better": ["lower", "neither", "lower"], "rows": [
          {"name": "paper", "ours": false, "note": "", "values": [2, 10, 2], "intervals": []},
          {"name": "asked for nothing", "ours": false, "note": "", "values": [null, 0, null], "intervals": []},
          {"name": "silent", "ours": false, "note": "10 missing", "values": [null, 0, null], "intervals": []},
          {"name": "truth in harmonics of order 2", "ours": false, "note": "", "values": [1, 10, 1],
           "intervals": []}]}]},
      {"id": "highlights", "title": "H", "text": "", "command": "", "missing": "", "pictures": [], "plots": [
        {"title": "P", "kind": "histogram", "x_label": "", "y_label": "", "groups": [], "x_low": null, "x_high": null,
         "missing_are_largest": false,
         "series": [{"name": "tan", "ours": false, "values": [1], "x": [], "intervals": []}]}],
       "tables": [{"title": "By tone", "note": "", "names_are": "method", "columns": ["tan, n = 2", "light, n = 2"],
         "decimals": [], "better": [], "rows": []}]}]})");
}

TEST(MakeReadable, AnEarlierReportOfTheSamePartsIsNotTold) {
  const std::string head = "Faceprobe 0.1.0; parts measured: relighting.";
  const std::string rest = "\n\nThe other parts are from an earlier report: ";
  eval::PaperReport report;
  report.made_with = head + rest + head + rest + "Faceprobe 0.1.0. 100 photos.";
  make_readable(report);
  EXPECT_EQ(report.made_with, head + rest + "Faceprobe 0.1.0. 100 photos.");
  // Of other parts something is left.
  report.made_with = head + rest + "Faceprobe 0.1.0; parts measured: directions." + rest + "Faceprobe 0.1.0.";
  const std::string told = report.made_with;
  make_readable(report);
  EXPECT_EQ(report.made_with, told);
}

TEST(MakeReadable, NamesTheCommandOfToday) {
  eval::PaperReport report;
  report.sections.push_back({.id = "direction_yale", .title = "Y", .command = "bench_direction --data DIR --set yale"});
  make_readable(report);
  EXPECT_EQ(report.sections[0].command, "faceprobe eval direction --data DIR --set yale");
  EXPECT_EQ(report.sections[0].notes.find("Gardner"), std::string::npos);  // no rivals, nothing to say of them
  report.sections[0].tables.push_back({.title = "T", .rows = {{.name = "lombardi and nishino, lite"}}});
  make_readable(report);
  EXPECT_NE(report.sections[0].notes.find("Gardner"), std::string::npos);
}

TEST(MakeReadable, BringsEarlyReportsUpToDate) {
  eval::PaperReport report = early_report();
  EXPECT_TRUE(report.terms.empty());
  make_readable(report);
  EXPECT_EQ(report.made_with,
            "Faceprobe 0.1.0; parts measured: relighting, directions.\n\nThe other parts are from an earlier report: "
            "Faceprobe 0.1.0. 100 photos.");
  EXPECT_FALSE(report.terms.empty());
  const ReportTable& mirror = report.sections[0].tables[0];
  EXPECT_EQ(mirror.title, "Mirror sphere, si-RMSE");
  EXPECT_EQ(mirror.columns[2], eval::common_column(9));
  ASSERT_EQ(mirror.rows.size(), 3U);  // who was asked for nothing has no row, who was silent has
  EXPECT_EQ(mirror.rows[0].name, "paper's solver on our layers");
  EXPECT_EQ(mirror.rows[1].name, "silent");
  EXPECT_TRUE(mirror.rows[2].bound);
  EXPECT_NE(mirror.note.find("ranks nothing"), std::string::npos);
  EXPECT_TRUE(std::ranges::all_of(mirror.better, [](Better better) { return better == Better::kNeither; }));
  EXPECT_EQ(report.sections[1].plots[0].series[0].name, "Tan & Ikeuchi 2004");
  EXPECT_EQ(report.sections[1].tables[0].columns[0], "tan skin, n = 2");
  EXPECT_EQ(report.sections[1].notes, "");  // it has not the network that its note is about
}

TEST(MakeReadable, TwiceIsAsOnce) {
  eval::PaperReport report = early_report();
  make_readable(report);
  const eval::PaperReport once = report;
  make_readable(report);
  EXPECT_EQ(report, once);
  eval::PaperReport again = eval::report_from_json(eval::report_json(once));
  make_readable(again);
  EXPECT_EQ(eval::report_markdown(again), eval::report_markdown(once));
}

}  // namespace
}  // namespace faceprobe::cli::testing
