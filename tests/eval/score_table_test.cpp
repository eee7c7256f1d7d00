#include "faceprobe/eval/score_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ScoreTable small_table() {
  ScoreTable table({.seed = 3, .resamples = 100});
  table.order_labels("skin", {"tan", "dark"});
  table.add({.method = "yang", .sample = "1", .groups = {{"skin", "dark"}}, .metrics = {{"rmse", 4}, {"ssim", 0.5}}});
  table.add({.method = "yang", .sample = "2", .groups = {{"skin", "tan"}}, .metrics = {{"rmse", 8}, {"ssim", 0.75}}});
  table.add({.method = "net", .sample = "1", .groups = {{"skin", "dark"}}, .metrics = {{"rmse", 2}}});
  table.add({.method = "net", .sample = "2", .groups = {{"skin", "tan"}}, .metrics = {{"rmse", kNan}, {"ssim", 1}}});
  return table;
}

TEST(ScoreTable, SelectsByMethodAndLabel) {
  const ScoreTable table = small_table();
  EXPECT_EQ(table.methods(), (std::vector<std::string>{"yang", "net"}));
  EXPECT_EQ(table.metrics(), (std::set<std::string>{"rmse", "ssim"}));
  EXPECT_EQ(table.values("rmse", {.method = "yang"}), (std::vector<double>{4, 8}));
  EXPECT_EQ(table.values("rmse", {.group = "skin", .label = "dark"}), (std::vector<double>{4, 2}));
  EXPECT_EQ(table.values("ssim", {"yang", "skin", "tan"}), (std::vector<double>{0.75}));
  EXPECT_TRUE(table.values("rmse", {.group = "hair", .label = "dark"}).empty());
  EXPECT_EQ(table.summary("rmse", {.method = "yang"}).mean, 6);
  EXPECT_EQ(table.histogram("rmse", {}, 0, 10, 2).counts, (std::vector<std::size_t>{2, 1}));
}

TEST(ScoreTable, CountsWhatAMethodFailedOn) {
  const Summary failed = small_table().summary("rmse", {.method = "net"});
  EXPECT_EQ(failed.count, 1U);
  EXPECT_EQ(failed.missing, 1U);
  EXPECT_EQ(small_table().summary("ssim", {.method = "net"}).missing, 0U);  // the metric is in one of the rows only
}

TEST(ScoreTable, LabelsComeInTheGivenOrderAndThenByName) {
  ScoreTable table = small_table();
  EXPECT_EQ(table.labels("skin"), (std::vector<std::string>{"tan", "dark"}));
  table.add({.method = "net", .sample = "3", .groups = {{"skin", "brown"}}});
  EXPECT_EQ(table.labels("skin"), (std::vector<std::string>{"tan", "dark", "brown"}));
}

TEST(ScoreTable, RefusesRowsThatWouldConfuse) {
  ScoreTable table = small_table();
  EXPECT_THROW(table.add({.method = "yang", .sample = "1"}), std::invalid_argument);  // there already
  EXPECT_THROW(table.add({.method = "", .sample = "9"}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = ""}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = "9", .groups = {{"method", "b"}}}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = "9", .groups = {{"person", "b"}}}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = "9", .groups = {{"rmse", "b"}}}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = "9", .metrics = {{"skin", 1}}}), std::invalid_argument);
  EXPECT_THROW(table.add({.method = "a", .sample = "9", .groups = {{"x", "b"}}, .metrics = {{"x", 1}}}),
               std::invalid_argument);
  EXPECT_EQ(table.rows().size(), 4U);
  EXPECT_EQ(table.groups(), (std::set<std::string>{"skin"}));
}

TEST(ScoreTable, Csv) {
  ScoreTable table;
  table.add({.method = "a,b", .sample = "say \"x\"", .groups = {{"g", "l"}}, .metrics = {{"m", 0.1}}, .person = "ann"});
  table.add({.method = "c", .sample = "2", .metrics = {{"m", kNan}, {"n", 1e300}}});
  EXPECT_EQ(table.csv(), "method,sample,person,g,m,n\r\n\"a,b\",\"say \"\"x\"\"\",ann,l,0.1,\r\nc,2,,,,1e+300\r\n");
  EXPECT_EQ(ScoreTable().csv(), "method,sample,person\r\n");
}

TEST(ScoreTable, Json) {
  const nlohmann::json json = nlohmann::json::parse(small_table().json());
  EXPECT_EQ(json["bootstrap"]["seed"], 3);
  ASSERT_EQ(json["rows"].size(), 4U);
  EXPECT_EQ(json["rows"][0]["metrics"]["rmse"], 4);
  EXPECT_EQ(json["rows"][0]["groups"]["skin"], "dark");
  EXPECT_TRUE(json["rows"][3]["metrics"]["rmse"].is_null());
  ASSERT_EQ(json["summaries"].size(), 12U);  // 2 metrics x 2 methods x (all + 2 labels)
  const nlohmann::json& first = json["summaries"][0];
  EXPECT_EQ(first["method"], "yang");
  EXPECT_EQ(first["metric"], "rmse");
  EXPECT_EQ(first["mean"], 6);
  EXPECT_EQ(first["mean_95"].size(), 2U);
  EXPECT_FALSE(first.contains("group"));
  EXPECT_EQ(json["summaries"][1]["label"], "tan");
  EXPECT_EQ(json["summaries"][1]["count"], 1);
  EXPECT_TRUE(json["summaries"][1]["mean_95"][0].is_null());  // of one value
}

TEST(ScoreTable, JsonTakesAnyBytesAndNoRows) {
  ScoreTable table;
  table.add({.method = "\xff", .sample = "1"});
  EXPECT_TRUE(nlohmann::json::parse(ScoreTable().json())["rows"].is_array());
  EXPECT_TRUE(nlohmann::json::parse(table.json())["rows"][0]["metrics"].is_object());
}

TEST(ScoreTable, Markdown) {
  ScoreTable table({.resamples = 10});
  for (const char* sample : {"1", "2", "3"}) table.add({.method = "a|b", .sample = sample, .metrics = {{"rmse", 2}}});
  table.add({.method = "c", .sample = "1", .metrics = {{"rmse", kNan}}});
  EXPECT_EQ(table.markdown("rmse", 1),
            "| rmse | n | mean | 95 % of the mean | median | p90 |\n"
            "|---|---:|---:|---:|---:|---:|\n"
            "| a\\|b | 3 | 2.0 | [2.0, 2.0] | 2.0 | 2.0 |\n"
            "| c | 0 (1 missing) | - | [-, -] | - | - |\n");
  EXPECT_EQ(small_table().markdown_by_group("rmse", "skin", 1),
            "| rmse | tan | dark |\n"
            "|---|---:|---:|\n"
            "| yang | 8.0 [-, -], n = 1 | 4.0 [-, -], n = 1 |\n"
            "| net | - [-, -], n = 0 (1 missing) | 2.0 [-, -], n = 1 |\n");
}

// Two photos each of three people.
ScoreTable three_people() {
  ScoreTable table({.seed = 3, .resamples = 200});
  for (int i = 0; i < 6; ++i) {
    table.add({.method = "net",
               .sample = std::to_string(i),
               .groups = {{"skin", i == 5 ? "dark" : "tan"}},
               .metrics = {{"rmse", 10 * (i / 2) + i % 2}},
               .person = "person " + std::to_string(i / 2)});
  }
  return table;
}

TEST(ScoreTable, IntervalsDrawPeople) {
  const ScoreTable table = three_people();
  const Summary s = table.summary("rmse");
  EXPECT_EQ(s.count, 6U);
  EXPECT_EQ(s.people, 3U);
  const std::vector<double> values = {0, 1, 10, 11, 20, 21};
  const std::vector<std::string> persons = {"a", "a", "b", "b", "c", "c"};
  const Summary expected = summarize(values, persons, {.seed = 3, .resamples = 200});
  EXPECT_EQ(s.mean_low, expected.mean_low);
  EXPECT_EQ(s.mean_high, expected.mean_high);
  // Of the one dark photo there is one person, of the tan ones all three.
  EXPECT_EQ(table.summary("rmse", {.group = "skin", .label = "dark"}).people, 1U);
  EXPECT_EQ(table.summary("rmse", {.group = "skin", .label = "tan"}).people, 3U);
  EXPECT_EQ(table.known_persons("rmse").at(5), "person 2");
  EXPECT_EQ(small_table().known_persons("rmse"), (std::vector<std::string>{"1", "2", "1", "2"}));  // the samples
}

// Photos differ by tens, methods by one: their intervals overlap, that of the differences knows.
TEST(ScoreTable, DifferencesArePaired) {
  ScoreTable table({.seed = 3, .resamples = 400});
  for (int i = 0; i < 20; ++i) {
    const std::string sample = std::to_string(i);
    const std::string person = std::to_string(i / 2);
    table.add({.method = "net", .sample = sample, .metrics = {{"rmse", 10.0 * i}}, .person = person});
    // A person's two photos differ alike: 1 for one half of the people, 1.5 for the other.
    const double more = i < 10 ? 1 : 1.5;
    table.add({.method = "yang", .sample = sample, .metrics = {{"rmse", 10.0 * i + more}}, .person = person});
  }
  EXPECT_LT(table.summary("rmse", {.method = "yang"}).mean_low, table.summary("rmse", {.method = "net"}).mean_high);
  const Summary d = table.difference("rmse", "net", {.method = "yang"});
  EXPECT_EQ(d.count, 20U);
  EXPECT_EQ(d.people, 10U);
  EXPECT_NEAR(d.mean, 1.25, 1e-12);
  EXPECT_GT(d.mean_low, 1 - 1e-12);
  EXPECT_LT(d.mean_high, 1.5 + 1e-12);
  // Ten people of deviation .25: 1.96 * .25 / sqrt(10) either way, of which there are few values and 400 draws.
  EXPECT_NEAR(d.mean_high - d.mean_low, 2 * 0.155, 0.08);
  EXPECT_NEAR(table.difference("rmse", "yang", {.method = "net"}).mean, -1.25, 1e-12);
  EXPECT_EQ(table.difference("rmse", "net", {.method = "net"}).mean, 0);
  EXPECT_THROW(table.difference("rmse", "net", {}), std::invalid_argument);
}

TEST(ScoreTable, DifferencesAreOfWhatBothAnswered) {
  ScoreTable table = small_table();
  table.add({.method = "yang", .sample = "3", .groups = {{"skin", "dark"}}, .metrics = {{"rmse", 5}}});
  const Summary d = table.difference("rmse", "net", {.method = "yang"});
  EXPECT_EQ(d.count, 1U);  // of sample 1: 4 - 2
  EXPECT_EQ(d.missing, 2U);
  EXPECT_EQ(d.mean, 2);
  EXPECT_EQ(table.difference("rmse", "net", {"yang", "skin", "tan"}).count, 0U);
  EXPECT_EQ(table.difference("rmse", "nobody", {.method = "yang"}).missing, 3U);
}

TEST(ScoreTable, TextsTellDifferencesWhereAsked) {
  ScoreTable table({.seed = 3, .resamples = 50});
  for (const char* sample : {"1", "2"}) {
    table.add({.method = "net", .sample = sample, .metrics = {{"rmse", 2}}});
    table.add({.method = "yang", .sample = sample, .metrics = {{"rmse", 5}}});
  }
  const std::string plain = table.markdown("rmse", 1);
  EXPECT_EQ(plain.find("minus"), std::string::npos);
  EXPECT_FALSE(nlohmann::json::parse(table.json())["summaries"][0].contains("minus"));
  table.compare_with("nobody");
  EXPECT_EQ(table.markdown("rmse", 1), plain);
  table.compare_with("net");
  EXPECT_EQ(table.markdown("rmse", 1),
            "| rmse | n | mean | 95 % of the mean | median | p90 | minus net |\n"
            "|---|---:|---:|---:|---:|---:|---:|\n"
            "| net | 2 | 2.0 | [2.0, 2.0] | 2.0 | 2.0 | |\n"
            "| yang | 2 | 5.0 | [5.0, 5.0] | 5.0 | 5.0 | 3.0 [3.0, 3.0] |\n");
  const nlohmann::json json = nlohmann::json::parse(table.json());
  EXPECT_FALSE(json["summaries"][0].contains("minus"));  // its own
  EXPECT_EQ(json["summaries"][1]["minus"]["method"], "net");
  EXPECT_EQ(json["summaries"][1]["minus"]["mean"], 3);
  EXPECT_EQ(json["summaries"][1]["minus"]["mean_95"][1], 3);
  EXPECT_EQ(json["summaries"][1]["minus"]["people"], 2);
}

TEST(ScoreTable, TablesTellPeople) {
  const ScoreTable table = three_people();
  EXPECT_NE(table.markdown("rmse", 1).find("| net | 6 of 3 people | 10.5 | ["), std::string::npos);
  const std::string by_skin = table.markdown_by_group("rmse", "skin", 1);
  EXPECT_NE(by_skin.find("n = 5 of 3 people |"), std::string::npos) << by_skin;
  EXPECT_NE(by_skin.find("n = 1 |"), std::string::npos) << by_skin;
  const nlohmann::json json = nlohmann::json::parse(table.json());
  EXPECT_EQ(json["rows"][5]["person"], "person 2");
  EXPECT_EQ(json["summaries"][0]["people"], 3);
  EXPECT_FALSE(nlohmann::json::parse(small_table().json())["rows"][0].contains("person"));
}

}  // namespace
}  // namespace faceprobe::eval
