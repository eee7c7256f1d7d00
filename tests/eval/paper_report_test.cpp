#include "faceprobe/eval/paper_report.h"

#include "eval/report/html.h"
#include "eval/report/picture_text.h"
#include "eval/xml_check.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/random.h"
#include "faceprobe/eval/paired_column.h"
#include "faceprobe/io/picture_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

ByteImage speckles(int width, int height, int channels) {
  ByteImage image(width, height, channels);
  Random random({static_cast<std::uint64_t>(channels)});
  for (std::uint8_t& value : image.values()) value = static_cast<std::uint8_t>(random.below(256));
  return image;
}

ReportTable small_report_table() {
  return {.title = "RMSE",
          .note = "Of 255.",
          .columns = {"error", "likeness", "n"},
          .rows = {{.name = "a", .values = {2.04, 0.5, 10}, .intervals = {std::pair(1.0, 3.0)}},
                   {.name = "b", .values = {std::nullopt, 0.75, 9}, .note = "1 missing"},
                   {.name = "net", .values = {1.96, 0.25}, .ours = true},
                   {.name = "d", .values = {2.06, kNan, 11}}},
          .decimals = {1, 2, 0},
          .better = {Better::kLower, Better::kHigher, Better::kNeither}};
}

ReportSection full_section() {
  Random random({5});
  ReportSection section{.id = "sun", .title = "The sun", .text = "One.\n\nTwo.", .command = "faceprobe eval relight"};
  section.tables = {small_report_table()};
  section.tables[0].rows[3].values[1].reset();  // NaN comes back as missing
  section.tables[0].rows[0].values[0] = 0.1 + 0.2;
  ReportPlot plot{.title = "Errors", .x_label = "degrees", .series = {{.name = "net", .ours = true}}, .x_high = 1.0 / 3};
  for (int i = 0; i < 50; ++i) plot.series[0].values.push_back(random.uniform() * std::pow(10, i - 25));
  section.plots = {plot,
                   {.title = "Shares",
                    .kind = PlotKind::kCumulative,
                    .series = {{.name = "a", .values = {1}}},
                    .missing_are_largest = true},
                   {.title = "Bars",
                    .kind = PlotKind::kBars,
                    .series = {{.name = "a", .values = {1, 2}, .intervals = {std::nullopt, std::pair(0.1, 1e300)}}},
                    .groups = {"dark", "tan"}},
                   {.title = "Lines",
                    .x_label = "x",
                    .y_label = "y",
                    .kind = PlotKind::kLines,
                    .series = {{.name = "a", .values = {1}, .x = {-0.7}}}}};
  section.pictures = {{.title = "Grey", .picture = speckles(7, 5, 1)},
                      {.title = "Colour", .caption = "Made.", .picture = speckles(64, 33, 3)},
                      {.title = "Clear", .picture = speckles(3, 11, 4)},
                      {.title = "None", .picture = ByteImage()}};
  section.missing = "The photos are not published.";
  section.notes = "Beware.";
  section.tables[0].rows[1].bound = true;
  return section;
}

TEST(PaperReport, PageIsWellFormedAndComplete) {
  const PaperReport report{.title = "Report", .made_with = "1.2.3", .sections = {full_section()}};
  const std::string html = report_html(report);
  EXPECT_EQ(testing::XmlCheck::problem(html), "");
  for (const char* part : {"<h1>Report</h1>", "<p>1.2.3</p>", "<a href=\"#sun\">The sun</a>", "<section id=\"sun\">",
                           "<p>One.</p>\n<p>Two.</p>", "<code>faceprobe eval relight</code>", "<caption>RMSE</caption>",
                           "<figcaption>Errors</figcaption>", "The photos are not published.", "There is no picture.",
                           "@page", "prefers-color-scheme: dark"}) {
    EXPECT_TRUE(has(html, part)) << part;
  }
  EXPECT_TRUE(has(html, "src=\"" + io::png_data_uri(report.sections[0].pictures[1].picture) + "\""));
  EXPECT_EQ(html, report_html(report));
  // Nothing is fetched: what a page can load stands in src, href or url().
  for (const char* part : {"<script", "<link", "@import", "url(", "src=\"http", "href=\"http"}) {
    EXPECT_FALSE(has(html, part)) << part;
  }
}

// The check itself has to find something.
TEST(PaperReport, WellFormedCheckFindsFaults) {
  for (const char* fault : {"<a><b></a></b>", "<a>", "<a>&nbsp;</a>", "<a>x < y</a>", "<a b=c/>",
                            "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a/><a/>", "<a>\x01</a>", "<a", "x<a/>"}) {
    EXPECT_NE(testing::XmlCheck::problem(fault), "") << fault;
  }
  EXPECT_EQ(testing::XmlCheck::problem("<!DOCTYPE html>\n<a b=\"&lt;\">x<c/>&amp;</a>\n"), "");
}

TEST(PaperReport, EscapesNamesEverywhere) {
  const std::string name = "<b>\"A\" & 'B'\x01";
  ReportSection section{.id = name, .title = name, .text = name, .command = name, .missing = name};
  section.tables = {{.title = name,
                     .note = name,
                     .names_are = name,
                     .columns = {name},
                     .rows = {{.name = name, .values = {1}, .note = name}}}};
  for (const PlotKind kind : {PlotKind::kHistogram, PlotKind::kCumulative, PlotKind::kBars, PlotKind::kLines}) {
    section.plots.push_back({.title = name,
                             .x_label = name,
                             .y_label = name,
                             .kind = kind,
                             .series = {{.name = name, .values = {1}, .x = {2}}}});
  }
  section.plots[2].groups = {name};
  section.pictures = {{.title = name, .caption = name, .picture = speckles(2, 2, 3)}};
  const std::string html = report_html({.title = name, .made_with = name, .sections = {section, section}});
  EXPECT_EQ(testing::XmlCheck::problem(html), "");
  EXPECT_FALSE(has(html, "<b>"));
  EXPECT_TRUE(has(html, "&lt;b&gt;&quot;A&quot; &amp; &#39;B&#39;\uFFFD"));
}

TEST(PaperReport, IdsAreUnique) {
  std::vector<std::string> taken;
  EXPECT_EQ(unique_id("sun", taken), "sun");
  EXPECT_EQ(unique_id("sun", taken), "sun-2");
  EXPECT_EQ(unique_id("a b/c", taken), "a-b-c");
  EXPECT_EQ(unique_id("", taken), "section");
  EXPECT_EQ(unique_id("7", taken), "section-7");
  const std::string html = report_html({.title = "t", .sections = {full_section(), full_section()}});
  for (const char* id : {"\"sun\"", "\"sun-2\"", "\"sun-plot-title\"", "\"sun-plot-4-title\"", "\"sun-2-plot-title\""}) {
    const std::string place = std::string(" id=") + id;
    EXPECT_TRUE(has(html, place)) << id;
    EXPECT_EQ(html.find(place), html.rfind(place)) << id;
  }
}

TEST(PaperReport, BestValuesAreBold) {
  const std::string html =
      report_html({.title = "t", .sections = {{.id = "s", .title = "s", .tables = {small_report_table()}}}});
  // 1.96 is the lowest and shows as 2.0, as 2.04 does: both. 2.06 shows as 2.1.
  EXPECT_TRUE(has(
      html, "<td class=\"of\"><strong>2.0</strong></td><td class=\"range\">[1.0, 3.0]</td><td>0.50</td><td>10</td>"))
      << html;
  EXPECT_TRUE(has(html,
                  "<small>1 missing</small></th><td class=\"of\">-</td><td "
                  "class=\"range\"></td><td><strong>0.75</strong></td><td>9</td>"));
  EXPECT_TRUE(has(
      html,
      "<tr class=\"ours\"><th scope=\"row\">net <small>ours</small></th><td class=\"of\"><strong>2.0</strong></td><td "
      "class=\"range\"></td><td>0.25</td><td>-</td>"));
  EXPECT_TRUE(has(html, "2.1</td><td class=\"range\"></td><td>-</td><td>11</td>"));
  EXPECT_TRUE(has(html, "error\u00a0<abbr title=\"lower is better\">"));
  EXPECT_TRUE(has(html, "likeness\u00a0<abbr title=\"higher is better\">"));
  EXPECT_TRUE(has(html, "<th scope=\"col\">n</th>"));
  const std::string markdown =
      report_markdown({.title = "t", .sections = {{.id = "s", .title = "S", .tables = {small_report_table()}}}});
  EXPECT_TRUE(markdown.starts_with("# t\n\nHow to read the tables: ")) << markdown;
  EXPECT_TRUE(
      markdown.ends_with("\n\n## S\n\n### RMSE\n\n| method | error | likeness | n |\n|---|---:|---:|---:|\n"
                         "| a | **2.0** [1.0, 3.0] | 0.50 | 10 |\n| b (1 missing) | - | **0.75** | 9 |\n"
                         "| net (ours) | **2.0** | 0.25 | - |\n| d | 2.1 | - | 11 |\n\nOf 255.\n"))
      << markdown;
}

TEST(PaperReport, BoundsAreNotTheBest) {
  ReportTable table{.title = "t",
                    .columns = {"x"},
                    .rows = {{.name = "a", .values = {2}},
                             {.name = "told", .values = {1}, .bound = true},
                             {.name = "told and as good", .values = {2}, .bound = true},
                             {.name = "b", .values = {3}}},
                    .better = {Better::kLower}};
  PaperReport report{.title = "t", .sections = {{.id = "s", .title = "s", .tables = {table}}}};
  const std::string markdown = report_markdown(report);
  EXPECT_TRUE(has(markdown, "| a | **2.000** |\n| told (bound) | 1.000 |\n| told and as good (bound) | 2.000 |\n"))
      << markdown;
  EXPECT_TRUE(has(markdown, "\"bound\""));
  EXPECT_TRUE(has(report_html(report), "told <small>bound</small>"));
  // One method and bounds: nothing to compare.
  report.sections[0].tables[0].rows.pop_back();
  EXPECT_FALSE(has(report_markdown(report), "**2.000**"));
}

TEST(PaperReport, LegendTellsOfWhatIsThere) {
  EXPECT_EQ(how_to_read({.title = "t", .sections = {{.id = "s", .title = "s"}}}), "");
  ReportTable table{.title = "t", .columns = {"mean"}, .rows = {{.name = "a", .values = {1}}}};
  PaperReport report{.title = "t", .sections = {{.id = "s", .title = "s", .tables = {table}}}};
  const std::string plain = how_to_read(report);
  EXPECT_TRUE(has(plain, "95 % interval of the mean by bootstrap"));
  for (const char* mark : {"\"ours\"", "\"bound\"", "\"earlier\"", "a column more"})
    EXPECT_FALSE(has(plain, mark)) << mark;
  report.sections[0].tables[0].columns.push_back(common_column(7));
  report.sections[0].tables[0].rows.push_back({.name = "b", .ours = true, .note = "2 missing, earlier", .bound = true});
  const std::string full = how_to_read(report);
  for (const char* mark : {"\"ours\"", "\"bound\"", "\"earlier\"", "a column more"})
    EXPECT_TRUE(has(full, mark)) << mark;
  EXPECT_EQ(marks_of(report.sections[0].tables[0].rows[1]), "ours, bound, 2 missing, earlier");
}

TEST(PaperReport, TermsAndNotesAreShown) {
  const PaperReport report{.title = "t",
                           .terms = {{"lite", "a < b"}},
                           .sections = {{.id = "s", .title = "S", .text = "Text.", .notes = "Beware."}}};
  const std::string html = report_html(report);
  EXPECT_EQ(testing::XmlCheck::problem(html), "");
  EXPECT_TRUE(has(html, "<dt>lite</dt><dd>a &lt; b</dd>"));
  EXPECT_TRUE(has(html, "<p>Text.</p>\n<p>Beware.</p>"));
  EXPECT_EQ(report_markdown(report), "# t\n\n- **lite**: a < b\n\n## S\n\nText.\n\nBeware.\n");
  EXPECT_EQ(report_from_json(report_json(report)), report);
}

TEST(PaperReport, OneValueIsNotTheBest) {
  ReportTable table{
      .title = "t", .columns = {"x"}, .rows = {{.name = "a", .values = {1}}, {.name = "b"}}, .better = {Better::kLower}};
  EXPECT_FALSE(
      has(report_html({.title = "t", .sections = {{.id = "s", .title = "s", .tables = {table}}}}), "<strong>"));
  table.rows[1].values = {-0.0001};  // below zero by less than is shown
  const std::string html = report_html({.title = "t", .sections = {{.id = "s", .title = "s", .tables = {table}}}});
  EXPECT_TRUE(has(html, "<td><strong>0.000</strong></td>"));
}

TEST(PaperReport, WhatIsEmptySaysSo) {
  const std::string nothing = report_html({.title = ""});
  EXPECT_EQ(testing::XmlCheck::problem(nothing), "");
  EXPECT_TRUE(has(nothing, "This report has no sections."));
  EXPECT_EQ(report_markdown({.title = ""}), "");
  EXPECT_EQ(report_csv({.title = ""}), "section,table,row,column,value,low,high,marks\r\n");
  EXPECT_TRUE(nlohmann::json::parse(report_json({.title = ""}))["sections"].empty());

  ReportSection section{.id = "s", .title = "S"};
  EXPECT_TRUE(
      has(report_html({.title = "t", .sections = {section}}), "This section has no tables, plots or pictures."));
  section.tables = {{.title = "Bare"}, {.title = "No rows", .columns = {"mean"}, .better = {Better::kLower}}};
  section.plots = {{.title = "Plain"}};
  section.pictures = {{.title = "Blank"}};
  const std::string html = report_html({.title = "t", .sections = {section}});
  EXPECT_EQ(testing::XmlCheck::problem(html), "");
  EXPECT_TRUE(has(html, "This table has no rows."));
  EXPECT_TRUE(has(html, "There are no values to plot."));
  EXPECT_TRUE(has(html, "There is no picture."));
  EXPECT_TRUE(has(report_markdown({.title = "t", .sections = {section}}), "### No rows\n\nThis table has no rows.\n"));
}

TEST(PaperReport, ContentsTellWhatIsMissing) {
  ReportSection whole = full_section();
  const std::string html =
      report_html({.title = "t", .sections = {whole, {.id = "b", .title = "B", .missing = "No data."}}});
  EXPECT_TRUE(has(html, "The sun</a> (in part)"));
  EXPECT_TRUE(has(html, "B</a> (not here)"));
  EXPECT_TRUE(has(html, "<p class=\"missing\"><strong>Not here:</strong> No data.</p>"));
}

TEST(PaperReport, SectionComesBackFromJson) {
  const ReportSection section = full_section();
  const ReportSection back = section_from_json(section_json(section));
  EXPECT_EQ(back, section);
  ASSERT_EQ(back.pictures.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(back.pictures[i].picture, section.pictures[i].picture) << i;
  EXPECT_EQ(back.plots[0].series[0].values, section.plots[0].series[0].values);
  EXPECT_EQ(report_html({.title = "t", .sections = {back}}), report_html({.title = "t", .sections = {section}}));
  EXPECT_EQ(section_from_json(section_json({.id = "", .title = ""})), (ReportSection{.id = "", .title = ""}));
}

TEST(PaperReport, MissingNumbersComeBackAsMissing) {
  ReportSection section{.id = "s", .title = "s"};
  section.tables = {
      {.title = "t", .columns = {"x"}, .rows = {{.name = "a", .values = {kNan}, .intervals = {std::pair(kNan, 1.0)}}}}};
  section.plots = {{.title = "p", .series = {{.name = "a", .values = {1, kNan, INFINITY}}}}};
  const ReportSection back = section_from_json(section_json(section));
  EXPECT_FALSE(back.tables[0].rows[0].values[0].has_value());
  EXPECT_FALSE(back.tables[0].rows[0].intervals[0].has_value());
  EXPECT_EQ(back.plots[0].series[0].values[0], 1);
  EXPECT_TRUE(std::isnan(back.plots[0].series[0].values[1]));
  EXPECT_TRUE(std::isnan(back.plots[0].series[0].values[2]));
}

TEST(PaperReport, RefusesOtherSections) {
  const std::string good = section_json(full_section());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("{}"), good.substr(0, good.size() / 2),
        changed("section-1", "section-0"), changed("\"histogram\"", "\"pie\""), changed("\"lower\"", "\"worse\""),
        changed("\"ours\": false", "\"ours\": 3.5e"), changed("\"names_are\"", "\"names\""),
        changed("data:image/png;base64,", "data:image/png;base64,!"),
        changed("data:image/png;base64,iVBOR", "data:image/png;base64,jVBOR")}) {
    try {
      section_from_json(text);
      ADD_FAILURE() << text.substr(0, 200);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
    }
  }
}

TEST(PaperReport, PicturesComeBackFromText) {
  // Sizes whose bytes end in each way that base64 pads.
  for (int width = 1; width < 12; ++width) {
    const ByteImage picture = speckles(width, 3, 3);
    EXPECT_EQ(picture_of_data_uri(io::png_data_uri(picture)), picture);
  }
  for (const char* text : {"", "data:image/png;base64,", "data:image/png;base64,AAA", "data:image/png;base64,AAAA",
                           "data:image/png;base64,A==="}) {
    EXPECT_THROW(picture_of_data_uri(text), Error) << text;
  }
}

TEST(PaperReport, JsonHasTheValues) {
  const nlohmann::json json =
      nlohmann::json::parse(report_json({.title = "T", .made_with = "M", .sections = {full_section()}}));
  EXPECT_EQ(json["title"], "T");
  EXPECT_EQ(json["made_with"], "M");
  const nlohmann::json& section = json["sections"][0];
  EXPECT_EQ(section["tables"][0]["rows"][0]["values"][0], 0.1 + 0.2);
  EXPECT_TRUE(section["tables"][0]["rows"][1]["values"][0].is_null());
  EXPECT_EQ(section["plots"][0]["series"][0]["values"].size(), 50U);
  EXPECT_EQ(section["pictures"][1]["title"], "Colour");
  EXPECT_EQ(section["pictures"][1]["size_px"], (std::vector<int>{64, 33}));
  EXPECT_FALSE(has(json.dump(), "base64"));
}

TEST(PaperReport, JsonIsReadBackButForThePictures) {
  PaperReport report{.title = "T", .made_with = "M", .sections = {full_section()}};
  const PaperReport back = report_from_json(report_json(report));
  EXPECT_EQ(report_markdown(back), report_markdown(report));
  EXPECT_EQ(report_csv(back), report_csv(report));  // exact numbers
  ASSERT_EQ(back.sections.size(), 1U);
  EXPECT_EQ(back.sections[0].pictures.size(), report.sections[0].pictures.size());
  EXPECT_TRUE(back.sections[0].pictures[0].picture.empty());
  for (const char* text : {"", "[]", "{}", R"({"title": "T", "made_with": "", "sections": [{}]})"})
    EXPECT_THROW(report_from_json(text), Error) << text;
}

TEST(PaperReport, CsvHasOneLineAValue) {
  ReportTable table = small_report_table();
  table.title = "a, \"b\"";
  table.columns.resize(1);
  for (ReportTable::Row& row : table.rows) row.values.resize(1);
  table.rows[0].values[0] = 0.1;
  EXPECT_EQ(report_csv({.title = "t", .sections = {{.id = "s", .title = "S", .tables = {table}}}}),
            "section,table,row,column,value,low,high,marks\r\ns,\"a, \"\"b\"\"\",a,error,0.1,1,3,\r\ns,\"a, "
            "\"\"b\"\"\",b,error,,,,1 missing\r\n"
            "s,\"a, \"\"b\"\"\",net,error,1.96,,,ours\r\ns,\"a, \"\"b\"\"\",d,error,2.06,,,\r\n");
}

TEST(PaperReport, CsvMarksWhatAnEarlierVersionMeasured) {
  const ReportTable table{
      .title = "t",
      .columns = {"x"},
      .rows = {{.name = "a", .values = {1}, .bound = true}, {.name = "b", .values = {2}, .note = "earlier"}}};
  PaperReport report{.title = "t", .sections = {{.id = "s", .title = "S", .tables = {table}}}};
  EXPECT_TRUE(has(report_csv(report), "a,x,1,,,bound\r\ns,t,b,x,2,,,earlier\r\n")) << report_csv(report);
  report.sections[0].text = "These figures are an earlier version's.";
  EXPECT_TRUE(has(report_csv(report), "a,x,1,,,\"bound, earlier\"\r\ns,t,b,x,2,,,earlier\r\n")) << report_csv(report);
}

TEST(PaperReport, RefusesRowsWithTooManyValues) {
  const PaperReport report{
      .title = "t",
      .sections = {{.id = "s", .title = "S", .tables = {{.title = "t", .rows = {{.name = "a", .values = {1}}}}}}}};
  EXPECT_THROW(report_html(report), std::invalid_argument);
  EXPECT_THROW(report_json(report), std::invalid_argument);
  EXPECT_THROW(report_csv(report), std::invalid_argument);
  EXPECT_THROW(report_markdown(report), std::invalid_argument);
}

ScoreTable four_photos() {
  ScoreTable scores({.seed = 1, .resamples = 50});
  scores.order_labels("skin", {"tan", "dark"});
  for (int i = 0; i < 4; ++i) {
    const std::string sample = std::to_string(i);
    const std::string skin = i < 2 ? "dark" : "tan";
    scores.add({.method = "yang", .sample = sample, .groups = {{"skin", skin}}, .metrics = {{"rmse", 4.0 + i}}});
    scores.add(
        {.method = "net", .sample = sample, .groups = {{"skin", skin}}, .metrics = {{"rmse", i == 3 ? kNan : 1.0 + i}}});
  }
  scores.add({.method = "net", .sample = "other", .groups = {{"skin", "tan"}}, .metrics = {{"ssim", 1}}});
  return scores;
}

TEST(ScoreReport, TableOfMethods) {
  const ReportTable table = table_of(four_photos(), "rmse", "RMSE", 1, {"net"});
  // One answered but three photos: their means over all they answered do not compare.
  EXPECT_EQ(table.columns, (std::vector<std::string>{"mean", "median", "n", "mean of the 3 that all of this run have"}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].values, (std::vector<std::optional<double>>{5.5, 5.5, 4, 5}));
  EXPECT_EQ(table.rows[1].values, (std::vector<std::optional<double>>{2, 2, 3, 2}));
  EXPECT_EQ(table.rows[1].note, "1 missing");  // the row without the metric is none of it
  EXPECT_TRUE(table.rows[1].ours);
  EXPECT_FALSE(table.rows[0].ours);
  const Summary s = four_photos().summary("rmse", {.method = "yang"});
  EXPECT_EQ(table.rows[0].intervals[0], std::pair(s.mean_low, s.mean_high));
  EXPECT_EQ(table.better, (std::vector<Better>{Better::kNeither, Better::kNeither, Better::kNeither, Better::kLower}));
}

TEST(ScoreReport, TableOfMethodsThatAnsweredAll) {
  ScoreTable scores({.seed = 1, .resamples = 50});
  for (const char* sample : {"1", "2"}) {
    for (const char* method : {"yang", "net"})
      scores.add({.method = method, .sample = sample, .metrics = {{"rmse", 2}}});
    scores.add(
        {.method = "silent", .sample = sample, .metrics = {{"rmse", kNan}}});  // answers nothing: no reason to drop all
  }
  const ReportTable table = table_of(scores, "rmse", "RMSE");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"mean", "median", "n"}));
  EXPECT_EQ(table.better, (std::vector<Better>{Better::kLower, Better::kLower, Better::kNeither}));
}

TEST(ScoreReport, WhoWasNotAskedHasNoLine) {
  ScoreTable scores = four_photos();
  scores.add({.method = "other", .sample = "0", .groups = {{"skin", "dark"}}, .metrics = {{"ssim", 1}}});
  EXPECT_EQ(table_of(scores, "rmse", "RMSE").rows.size(), 2U);
  EXPECT_EQ(table_by_group(scores, "rmse", "skin", "By skin").rows.size(), 2U);
  EXPECT_EQ(table_of(scores, "rmse", "RMSE").rows[1].values[3], 2);  // the means over common samples keep their rows
}

TEST(ScoreReport, TableOfMetrics) {
  ScoreTable scores({.seed = 1, .resamples = 50});
  for (const char* sample : {"1", "2"}) {
    scores.add({.method = "a", .sample = sample, .metrics = {{"x", 2}, {"y", 4}}});
    scores.add({.method = "b", .sample = sample, .metrics = {{"x", 3}, {"y", sample[0] == '1' ? kNan : 1}}});
  }
  const ReportTable table = table_of_metrics(scores, {{"x", "first"}, {"y", "second"}}, "Both", 1, {"a"});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(table.rows[0].values, (std::vector<std::optional<double>>{2, 4}));
  EXPECT_EQ(table.rows[1].values, (std::vector<std::optional<double>>{3, 1}));
  EXPECT_EQ(table.rows[1].note, "1 missing");
  EXPECT_EQ(table.rows[0].intervals[0], std::pair(2.0, 2.0));
  EXPECT_EQ(table.better, (std::vector<Better>{Better::kLower, Better::kNeither}));
  EXPECT_TRUE(table.rows[0].ours);
}

TEST(ScoreReport, TableWithDifferencesToOurs) {
  const ScoreTable scores = four_photos();
  const ReportTable plain = table_of(scores, "rmse", "RMSE", 1, {"net"});
  const ReportTable table = paired_table_of(scores, "rmse", "RMSE", 1, {"net"});
  ASSERT_EQ(table.columns.size(), plain.columns.size() + 1);
  EXPECT_EQ(table.columns.back(), kDifferenceColumn);
  EXPECT_EQ(table.decimals.back(), 1);
  EXPECT_EQ(table.better.back(), Better::kNeither);
  EXPECT_EQ(table.rows[0].values.back(), 3);  // of the three photos that both have
  EXPECT_EQ(table.rows[0].intervals.back(), std::pair(3.0, 3.0));
  EXPECT_FALSE(table.rows[1].values.back().has_value());  // ours
  EXPECT_TRUE(has(table.note, "Minus ours"));
  for (std::size_t i = 0; i < plain.columns.size(); ++i) EXPECT_EQ(table.rows[0].values[i], plain.rows[0].values[i]);
  EXPECT_TRUE(has(report_markdown({.title = "t", .sections = {{.id = "s", .title = "s", .tables = {table}}}}),
                  "3.0 [3.0, 3.0] |"));
  // Where none of ours is in the table there is nothing to compare with.
  EXPECT_EQ(paired_table_of(scores, "rmse", "RMSE", 1, {"nobody"}), table_of(scores, "rmse", "RMSE", 1, {"nobody"}));
}

TEST(ScoreReport, TableByGroup) {
  ScoreTable scores = four_photos();
  const ReportTable table = table_by_group(scores, "rmse", "skin", "By skin", 1, {"net"});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"tan, n = 2", "dark, n = 2"}));
  EXPECT_EQ(table.rows[0].values, (std::vector<std::optional<double>>{6.5, 4.5}));
  EXPECT_EQ(table.rows[0].note, "");
  EXPECT_EQ(table.rows[1].values, (std::vector<std::optional<double>>{3, 1.5}));
  EXPECT_EQ(table.rows[1].note, "tan 1 missing");
  EXPECT_EQ(table.better, (std::vector<Better>{Better::kNeither, Better::kLower}));  // tan's means are of other photos
  EXPECT_TRUE(table.rows[1].ours);
  EXPECT_FALSE(table.rows[1].intervals[0].has_value());  // of one value
  // A photo that only one of them was given.
  scores.add({.method = "yang", .sample = "9", .groups = {{"skin", "dark"}}, .metrics = {{"rmse", 4}}});
  const ReportTable other = table_by_group(scores, "rmse", "skin", "By skin");
  EXPECT_EQ(other.columns, (std::vector<std::string>{"tan", "dark"}));
  EXPECT_EQ(other.rows[0].note, "tan n = 2, dark n = 3");
  EXPECT_EQ(other.rows[1].note, "tan n = 1 (1 missing), dark n = 2");
  EXPECT_TRUE(table_by_group(ScoreTable(), "m", "g", "t").rows.empty());
}

TEST(ScoreReport, Plots) {
  const ReportPlot histogram = histogram_of(four_photos(), "rmse", "t", "unit", {"net"});
  ASSERT_EQ(histogram.series.size(), 2U);
  EXPECT_EQ(histogram.x_label, "unit");
  EXPECT_EQ(histogram.series[0].values, (std::vector<double>{4, 5, 6, 7}));
  EXPECT_EQ(histogram.series[1].values.size(), 4U);
  EXPECT_TRUE(std::isnan(histogram.series[1].values[3]));
  EXPECT_TRUE(histogram.series[1].ours);
  EXPECT_EQ(cumulative_of(four_photos(), "rmse", "t", "unit").kind, PlotKind::kCumulative);
  const ReportPlot bars = bars_of(four_photos(), "rmse", "t", "unit", {}, "skin");
  EXPECT_EQ(bars.groups, (std::vector<std::string>{"tan", "dark"}));
  EXPECT_EQ(bars.series[0].values, (std::vector<double>{6.5, 4.5}));
  EXPECT_EQ(bars_of(four_photos(), "rmse", "t", "unit").series[1].values, (std::vector<double>{2}));
}

}  // namespace
}  // namespace faceprobe::eval
