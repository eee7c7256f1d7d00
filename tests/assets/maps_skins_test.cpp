#include "faceprobe/assets/maps.h"
#include "faceprobe/assets/skins.h"
#include "faceprobe/io/picture_file.h"
#include "file_fixtures.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <limits>

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::TempFolder;

// Through OpenImageIO itself: our own writer would not let these values pass.
void write_exr(const std::filesystem::path& path, float odd_value) {
  OIIO::ImageSpec spec(8, 4, 3, OIIO::TypeDesc::FLOAT);
  std::vector<float> texels(8 * 4 * 3, 0.5F);
  texels[(2 * 8 + 5) * 3 + 1] = odd_value;
  auto file = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(file && file->open(path.string(), spec));
  ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, texels.data()));
  ASSERT_TRUE(file->close());
}

TEST(LoadMaps, ReadsMapsInTheOrderOfTheirNames) {
  const TempFolder folder;
  EnvMap map(8, 4);
  map.radiance()(3, 1, 0) = 2.0F;
  io::write_env_map(folder / "b.hdr", map);
  map.radiance()(3, 1, 0) = 4.0F;
  io::write_env_map(folder / "a.exr", map);
  testing::write_text(folder / "train.csv", "no map");
  const auto maps = load_maps(folder.path());
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].first, "a");
  EXPECT_EQ(maps[0].second.radiance()(3, 1, 0), 4.0F);
  EXPECT_EQ(maps[1].first, "b");
  EXPECT_EQ(maps[1].second.radiance()(3, 1, 0), 2.0F);  // a power of two is exact in RGBE
}

TEST(LoadMaps, RefusesWhatIsNotFiniteAndNamesTheTexel) {
  const TempFolder folder;
  write_exr(folder / "sun.exr", std::numeric_limits<float>::infinity());
  expect_error(ExitCode::kInput, {"sun.exr", "infinity", "column 5, row 2"}, [&] { load_maps(folder.path()); });
  write_exr(folder / "sun.exr", std::nanf(""));
  expect_error(ExitCode::kInput, {"sun.exr", "NaN", "column 5, row 2"}, [&] { load_maps(folder.path()); });
  write_exr(folder / "sun.exr", 100.0F);
  EXPECT_EQ(load_maps(folder.path()).front().second.radiance()(5, 2, 1), 100.0F);
}

TEST(LoadMaps, RefusesFoldersWithoutMapsAndOtherShapes) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"no .hdr or .exr"}, [&] { load_maps(folder.path()); });
  expect_error(ExitCode::kInput, {"missing", "not a folder"}, [&] { load_maps(folder / "missing"); });
  io::write_picture(folder / "square.exr", Image(4, 4, 3, 0.5F));
  expect_error(ExitCode::kInput, {"square.exr", "4 x 4"}, [&] { load_maps(folder.path()); });
}

TEST(LoadSkins, ReadsTexturesByNameAndLeavesOtherPicturesOut) {
  const TempFolder folder;
  ByteImage skin(3, 2, 3);
  for (std::size_t i = 0; i < skin.values().size(); ++i) skin.data()[i] = static_cast<std::uint8_t>(13 * i);
  io::write_picture(folder / "002.png", skin);
  io::write_picture(folder / "001.png", skin);
  for (const char* other : {"coverage_mean.png", "001_gloss.png", "001_bump.png"})
    io::write_picture(folder / other, skin);
  testing::write_text(folder / "README.md", "no texture");
  const auto skins = load_skins(folder.path());
  ASSERT_EQ(skins.size(), 2U);
  EXPECT_EQ(skins[0].first, "001");
  EXPECT_EQ(skins[1].first, "002");
  EXPECT_EQ(skins[1].second, skin);  // bytes of sRGB to light and back
}

TEST(LoadSkins, RefusesFoldersWithoutTexturesAndBrokenOnes) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"no .jpg or .png"}, [&] { load_skins(folder.path()); });
  testing::write_text(folder / "broken.png", "no picture");
  expect_error(ExitCode::kInput, {"broken.png"}, [&] { load_skins(folder.path()); });
}

}  // namespace
}  // namespace faceprobe::assets
