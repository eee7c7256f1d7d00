// Objects whose highlights are known because they were made.
#include "paper/objects.h"

#include "faceprobe/io/picture_file.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace faceprobe::cli::testing {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

constexpr int kSide = 40;

// Red paint, darker towards the bottom as separators expect of objects, with a highlight of 50 on the middle sixteenth.
ByteImage painted(bool highlight) {
  ByteImage picture(kSide, kSide, 3);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool middle = std::abs(2 * x + 1 - kSide) < kSide / 4 && std::abs(2 * y + 1 - kSide) < kSide / 4;
      const int shade = 2 * kSide - y;
      const std::array<int, 3> paint = {2 * shade, shade, shade / 2};
      for (int c = 0; c < 3; ++c)
        picture(x, y, c) =
            static_cast<std::uint8_t>(paint[static_cast<std::size_t>(c)] + (highlight && middle ? 50 : 0));
    }
  }
  return picture;
}

std::vector<ObjectPicture> one_object(const TempFolder& folder) {
  io::write_picture(folder / "ball.png", painted(true));
  io::write_picture(folder / "ball_gt.png", painted(false));
  return {{"made", "ball", folder / "ball.png", folder / "ball_gt.png"}};
}

TEST(ObjectPictures, AreThoseOfTheSetsThatAreThere) {
  const TempFolder folder;
  EXPECT_TRUE(object_pictures(folder.path()).empty());
  std::filesystem::create_directory(folder / "shen");
  const std::vector<ObjectPicture> pictures = object_pictures(folder.path());
  ASSERT_EQ(pictures.size(), 4U);
  EXPECT_EQ(pictures[0].diffuse, folder / "shen" / "animals_gt.png");
  EXPECT_TRUE(pictures[0].published);
}

TEST(MeasureObjects, ABlackLayerMissesTheWholeHighlight) {
  const TempFolder folder;
  ObjectLayers seen;
  const eval::ScoreTable scores = measure_objects(
      one_object(folder), {.visit = [&](const ObjectPicture&, const ObjectLayers& layers) { seen = layers; }});
  const eval::Selection black{.method = "black layer"};
  const double rmse = 50 / 4.0;                                                 // on a sixteenth of the picture
  EXPECT_NEAR(scores.known_values("rmse_highlight", black).at(0), rmse, 1e-4);  // codes / 255 in float
  EXPECT_NEAR(scores.known_values("psnr_diffuse", black).at(0), 20 * std::log10(255 / rmse), 1e-9);
  EXPECT_NEAR(seen.highlight(kSide / 2, kSide / 2, 1), 50 / 255.0, 1e-6);
  EXPECT_EQ(seen.highlight(0, 0, 1), 0);
  EXPECT_EQ(scores.rows()[0].groups.at("pixels"), "40 x 40");
}

TEST(MeasureObjects, SeparatorsTakeTheHighlightOff) {
  const TempFolder folder;
  const eval::ScoreTable scores = measure_objects(one_object(folder), {});
  const double black = scores.known_values("rmse_highlight", {.method = "black layer"}).at(0);
  for (const highlight::Separator separator : kObjectSeparators) {
    const std::string name(separator_name(separator));
    EXPECT_LT(scores.known_values("rmse_highlight", {.method = name}).at(0), black / 2) << name;
    EXPECT_EQ(scores.known_values("seconds", {.method = name}).size(), 1U) << name;
  }
}

TEST(MeasureObjects, ATruthOfAnotherSizeIsRefused) {
  const TempFolder folder;
  const std::vector<ObjectPicture> pictures = one_object(folder);
  io::write_picture(pictures[0].diffuse, ByteImage(kSide, kSide + 1, 3));
  expect_error(ExitCode::kInput, {"ball_gt.png", "40 x 41", "40 x 40"}, [&] { measure_objects(pictures, {}); });
}

TEST(ReadCodeValues, GreyPicturesAreRefused) {
  const TempFolder folder;
  io::write_picture(folder / "grey.png", ByteImage(4, 4, 1));
  expect_error(ExitCode::kInput, {"grey.png", "three channels"}, [&] { read_code_values(folder / "grey.png"); });
}

}  // namespace
}  // namespace faceprobe::cli::testing
