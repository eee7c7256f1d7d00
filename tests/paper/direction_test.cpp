// The sets of known directions, as small made ones, and what a light straight ahead makes of them.
#include "faceprobe/core/angles.h"
#include "faceprobe/io/picture_file.h"
#include "paper/london.h"
#include "paper/yale.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace faceprobe::cli::testing {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

void write_text(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

void write_small_picture(const std::filesystem::path& file) {
  std::filesystem::create_directories(file.parent_path());
  io::write_picture(file, ByteImage(8, 8, 3, 90));
}

void write_yale(const std::filesystem::path& folder) {
  for (const char* name : {"a/front.png", "a/left.png", "a/far.png", "b/up.png"})
    write_small_picture(folder / "images" / name);
  write_text(folder / "lights.csv",
             "file,subject,azimuth_deg,elevation_deg\r\n"
             "a/front.png,a,5,0\r\na/left.png,a,40,0\r\na/far.png,a,-80,0\r\n"
             "b/gone.png,b,0,0\r\nb/up.png,b,0,25\r\n");
}

TEST(YalePictures, AreThoseThatAreThereWithTheirLightsInOurFrame) {
  const TempFolder folder;
  write_yale(folder.path());
  const std::vector<YalePicture> pictures = yale_pictures(folder.path(), 1);
  ASSERT_EQ(pictures.size(), 3U);  // one is too far off the axis, one has no file
  EXPECT_EQ(pictures[1].name, "left");
  EXPECT_EQ(pictures[1].subject, "a");
  EXPECT_EQ(pictures[2].subject, "b");
  EXPECT_NEAR(azimuth_deg(pictures[1].light), -40, 1e-9);  // the database counts towards the subject's right
  EXPECT_NEAR(elevation_deg(pictures[2].light), 25, 1e-9);
  EXPECT_NEAR(pictures[2].axis_deg, 25, 1e-9);
  const std::vector<YalePicture> every_second = yale_pictures(folder.path(), 2);
  ASSERT_EQ(every_second.size(), 2U);
  EXPECT_EQ(every_second[1].name, "up");
}

TEST(YalePictures, AnAngleThatIsNoneIsRefused) {
  const TempFolder folder;
  write_text(folder / "lights.csv", "file,subject,azimuth_deg,elevation_deg\nx.png,a,left,0\n");
  expect_error(ExitCode::kInput, {"lights.csv", "left"}, [&] { yale_pictures(folder.path(), 1); });
}

TEST(MeasureYale, StraightAheadIsOffByTheFlashsOwnAngle) {
  const TempFolder folder;
  write_yale(folder.path());
  const eval::ScoreTable scores = measure_yale(yale_pictures(folder.path(), 1), {});
  EXPECT_EQ(scores.methods(), std::vector<std::string>{kStraightAhead});
  // 25 degrees are of the second subset.
  EXPECT_EQ(scores.labels("flash"), (std::vector<std::string>{"0 - 12", "12 - 25", "25 - 50"}));
  EXPECT_NEAR(scores.known_values("main_light_deg", {.group = "flash", .label = "25 - 50"}).at(0), 40, 1e-9);
  EXPECT_EQ(scores.known_persons("main_light_deg"), (std::vector<std::string>{"a", "a", "b"}));
}

TEST(NormalsSetting, ChangesTheNormalsAlone) {
  pipeline::EstimateOptions base;
  base.max_patches = 77;
  for (const pipeline::NormalSource source :
       {pipeline::NormalSource::kMesh, pipeline::NormalSource::kNet, pipeline::NormalSource::kFit}) {
    const DirectionSetting setting = normals_setting(source, base);
    EXPECT_EQ(setting.options.normals, source);
    EXPECT_EQ(setting.options.max_patches, 77);
  }
  EXPECT_EQ(normals_setting(pipeline::NormalSource::kMesh, base).name, "normals of the mesh");
  EXPECT_EQ(normals_option(pipeline::NormalSource::kFit), "3dmm");
}

void write_london(const std::filesystem::path& folder) {
  for (const char* name : {"neutral_front/001_03.png", "smiling_front/001_08.png", "neutral_front/002_03.png",
                           "neutral_front/004_03.png", "smiling_front/004_08.png"})
    write_small_picture(folder / name);
  write_text(folder / "lights_from_catchlights.json",
             R"({"lights": [{"direction_x_right_y_up_z_to_camera": [0, 0, 2]},
                            {"direction_x_right_y_up_z_to_camera": [1, 0, 1]}]})");
  write_text(folder / "london_info.csv", "face_id,face_age,face_gender,face_eth\n001,20,female,west_asian\n");
}

TEST(ReadLondon, TakesPeopleWithBothPhotos) {
  const TempFolder folder;
  write_london(folder.path());
  const LondonSet london = read_london(folder.path(), 1);
  ASSERT_EQ(london.lights.size(), 2U);
  EXPECT_NEAR(london.lights[0].norm(), 1, 1e-12);
  ASSERT_EQ(london.people.size(), 2U);
  EXPECT_EQ(london.people[0].ethnicity, "west asian");
  EXPECT_EQ(london.people[1].id, "004");
  EXPECT_EQ(london.people[1].ethnicity, "");  // the table does not know this one
  EXPECT_EQ(read_london(folder.path(), 2).people.size(), 1U);
}

TEST(ReadLondon, ABrokenFileOfLightsIsRefused) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"lights_from_catchlights.json"}, [&] { read_london(folder.path(), 1); });
  write_text(folder / "lights_from_catchlights.json", R"({"lights": [{"direction_x_right_y_up_z_to_camera": [1]}]})");
  expect_error(ExitCode::kInput, {"lights_from_catchlights.json"}, [&] { read_london(folder.path(), 1); });
}

TEST(MeasureLondon, StraightAheadFindsOneLightOfTwoAndAgreesWithItself) {
  const TempFolder folder;
  write_london(folder.path());
  int photos = 0;
  const eval::ScoreTable scores = measure_london(read_london(folder.path(), 1), {}, [&] { ++photos; });
  EXPECT_EQ(photos, 4);
  EXPECT_EQ(scores.rows().size(), 4U);
  EXPECT_EQ(scores.summary("strongest_deg").people, 2U);
  const auto mean = [&](const char* metric) { return scores.summary(metric).mean; };
  EXPECT_NEAR(mean("strongest_deg"), 0, 1e-9);
  EXPECT_NEAR(mean("recall_deg"), 22.5, 1e-9);  // 0 and 45
  EXPECT_NEAR(mean("precision_deg"), 0, 1e-9);
  EXPECT_EQ(mean("lights"), 1);
  EXPECT_NEAR(mean("centroid_off_deg"), 0, 1e-9);
  EXPECT_EQ(scores.known_values("neutral_to_smiling_deg").size(), 2U);  // one a person
  EXPECT_TRUE(scores.known_values("map_correlation").empty());          // one direction is no map
}

}  // namespace
}  // namespace faceprobe::cli::testing
