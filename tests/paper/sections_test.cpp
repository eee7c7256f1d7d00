// Sections without their data say so, and those with them show what was measured.
#include "faceprobe/io/picture_file.h"
#include "paper/directions.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::cli::testing {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

PaperPlan plan_of(const TempFolder& folder) {
  PaperPlan plan;
  plan.data = folder.path();
  return plan;
}

TEST(DirectionSections, WithoutTheirDataSayWhatIsMissing) {
  const TempFolder folder;
  EXPECT_FALSE(has_directions(folder.path()));
  const Sections sections = measure_directions({.data = folder.path()});
  ASSERT_EQ(sections.size(), 2U);
  EXPECT_NE(sections[0].missing.find("real/yaleB"), std::string::npos);
  EXPECT_NE(sections[1].missing.find("real/portraits/london"), std::string::npos);
  for (const eval::ReportSection& section : sections) EXPECT_TRUE(section.tables.empty() && section.plots.empty());
}

TEST(DirectionSections, OneSetAloneIsOneSection) {
  const TempFolder folder;
  const Sections sections =
      measure_directions({.data = folder.path(),
                          .every = 5,
                          .yale = false,
                          .normals = {pipeline::NormalSource::kMesh, pipeline::NormalSource::kFit}});
  ASSERT_EQ(sections.size(), 1U);
  EXPECT_EQ(sections[0].command, "faceprobe eval direction --data DIR --set london --every 5 --normals mesh,3dmm");
}

TEST(DirectionSections, AStepOfNothingIsRefused) {
  expect_error(ExitCode::kUsage, {"every is 0"}, [] { measure_directions({.data = "nowhere", .every = 0}); });
}

TEST(ObjectSections, WithoutTheirDataSayWhatIsMissing) {
  const TempFolder folder;
  const Sections sections = object_sections(plan_of(folder));
  ASSERT_EQ(sections.size(), 1U);
  EXPECT_NE(sections[0].missing.find("specsep_objects/shen"), std::string::npos);
  EXPECT_NE(sections[0].missing.find("specsep_objects/mit"), std::string::npos);
  EXPECT_TRUE(sections[0].tables.empty());
}

TEST(ObjectSections, HavePublishedRowsAndAPictureOfEachRow) {
  const TempFolder folder;
  const std::filesystem::path set = folder / "real" / "specsep_objects" / "shen";
  std::filesystem::create_directories(set);
  for (const char* name : {"animals", "cups", "fruit", "masks"}) {
    ByteImage picture(24, 16, 3, 60);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 24; ++x) picture(x, y, 0) = 120;
    }
    io::write_picture(set / (std::string(name) + "_gt.png"), picture);
    for (int c = 0; c < 3; ++c) picture(5, 5, c) = 255;
    io::write_picture(set / (std::string(name) + ".png"), picture);
  }
  PaperPlan plan = plan_of(folder);
  int told = 0;
  plan.progress = [&](int done, int total) {
    EXPECT_EQ(total, 4);
    told = done;
  };
  const eval::ReportSection section = object_sections(plan).at(0);
  EXPECT_EQ(told, 4);
  EXPECT_EQ(section.missing.find("shen"), std::string::npos);
  ASSERT_EQ(section.tables.size(), 3U);
  const eval::ReportTable& psnr = section.tables[0];
  EXPECT_EQ(psnr.columns, (std::vector<std::string>{"animals", "cups", "fruit", "masks", "mean"}));
  const auto published = std::find_if(psnr.rows.begin(), psnr.rows.end(),
                                      [](const eval::ReportTable::Row& row) { return row.name == "yang, published"; });
  ASSERT_NE(published, psnr.rows.end());
  EXPECT_EQ(published->values[1], 37.5);
  EXPECT_EQ(section.tables[1].rows.size(), 4U);  // black layer and three separators, none published
  ASSERT_EQ(section.pictures.size(), 1U);
  // Five columns; pictures are not enlarged, and the titles stand above.
  EXPECT_GE(section.pictures[0].picture.height(), 4 * 16);
}

}  // namespace
}  // namespace faceprobe::cli::testing
