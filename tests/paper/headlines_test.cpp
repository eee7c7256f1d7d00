#include "paper/headlines.h"

#include "faceprobe/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::cli::testing {
namespace {

eval::PaperReport with_rows(std::vector<eval::ReportTable::Row> rows) {
  return {.title = "T",
          .sections = {
              {.id = "relighting",
               .title = "S",
               .tables = {{.title = "Glossy object", .columns = {"mean"}, .rows = {{.name = "other", .values = {1}}}},
                          {.title = "Diffuse object", .columns = {"mean", "median", "n"}, .rows = std::move(rows)}}}}};
}

TEST(Headlines, AreOursAndTheBestRival) {
  const std::string text = headlines(with_rows({{.name = "transport", .values = {28.26, 23, 97}, .ours = true},
                                                {.name = "transport without the prior", .values = {20, 1, 97}},
                                                {.name = "truth in harmonics of order 2", .values = {3, 1, 97}},
                                                {.name = "paper", .values = {43, 1, 97}},
                                                {.name = "knorr and kurz", .values = {41.5, 1, 97}},
                                                {.name = "ambient", .values = {52, 1, 97}},
                                                {.name = "failed", .values = {std::nullopt, std::nullopt, 0}}}));
  EXPECT_NE(text.find("mean of 97 synthetic photos | 28.3 | 41.5 (knorr and kurz) |\n"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);  // two of head, one line: the other sections are not there
}

TEST(Headlines, ThePapersOwnRowIsARival) {
  const std::string text = headlines(with_rows({{.name = "transport", .values = {28, 23, 97}, .ours = true},
                                                {.name = "paper", .values = {37.9, 1, 97}},
                                                {.name = "ambient", .values = {52, 1, 97}}}));
  EXPECT_NE(text.find("| 28.0 | 37.9 (paper) |\n"), std::string::npos) << text;
}

TEST(Headlines, TakeWhatAllAnswered) {
  eval::PaperReport report = with_rows({{.name = "transport", .values = {28, 23, 97, 25}, .ours = true},
                                        {.name = "ambient", .values = {20, 1, 50, 52}}});
  report.sections[0].tables[1].columns.push_back(eval::common_column(50));
  EXPECT_NE(headlines(report).find("| 25.0 | 52.0 (ambient) |\n"), std::string::npos) << headlines(report);
}

TEST(Headlines, BoundsAreNoRivals) {
  const std::string text = headlines(with_rows({{.name = "transport", .values = {28, 23, 97}, .ours = true},
                                                {.name = "told the answer", .values = {3, 1, 97}, .bound = true},
                                                {.name = "ambient", .values = {52, 1, 97}}}));
  EXPECT_NE(text.find("52.0 (ambient) |"), std::string::npos) << text;
}

TEST(Headlines, SayWhatAnEarlierVersionMeasured) {
  eval::PaperReport report = with_rows({{.name = "transport", .values = {28, 23, 97}, .ours = true},
                                        {.name = "legendre", .values = {45, 1, 97}, .note = "2 missing, earlier"}});
  EXPECT_NE(headlines(report).find("| 28.0 | 45.0 (legendre, earlier) |\n"), std::string::npos) << headlines(report);
  report.sections[0].text = "Photos.\n\nThese figures are an earlier version's.";
  EXPECT_NE(headlines(report).find("97 synthetic photos (both by an earlier version) | 28.0"), std::string::npos);
}

TEST(Headlines, NeedBothAndSaySo) {
  EXPECT_THROW(headlines({.title = "T"}), Error);
  EXPECT_THROW(headlines(with_rows({{.name = "transport", .values = {28}, .ours = true}})), Error);
  EXPECT_THROW(headlines(with_rows({{.name = "ambient", .values = {28}}})), Error);
}

}  // namespace
}  // namespace faceprobe::cli::testing
