#include "faceprobe/io/picture_file.h"

#include "faceprobe/core/color.h"
#include "faceprobe/io/data_files.h"
#include "fixtures.h"
#include "io/header_peek.h"

#include <cmath>
#include <limits>

namespace faceprobe::io {
namespace {

using namespace testing;
namespace fs = std::filesystem;

Image light(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    image.data()[i] = std::exp2(static_cast<float>(i % 23) - 8.0F) * (1.0F + 0.37F * static_cast<float>(i % 7) / 7.0F);
  }
  return image;
}

void expect_relative(const Image& found, const Image& expected, float relative) {
  ASSERT_TRUE(found.same_size(expected));
  ASSERT_EQ(found.channels(), expected.channels());
  for (std::size_t i = 0; i < found.values().size(); ++i) {
    ASSERT_NEAR(found.data()[i], expected.data()[i], relative * expected.data()[i]) << i;
  }
}

TEST(PictureFile, ExrRoundTrip) {
  TempFolder folder;
  for (const int channels : {1, 3}) {
    const Image image = light(33, 17, channels);
    write_picture(folder / "half.exr", image);
    expect_relative(read_linear_picture(folder / "half.exr"), image, 0x1p-11F);  // half: 11 bits, rounded
    write_picture(folder / "float.exr", image, {}, false);
    EXPECT_EQ(read_linear_picture(folder / "float.exr"), image);
  }
}

TEST(PictureFile, AlphaIsDroppedOnReading) {
  TempFolder folder;
  const Image image = light(9, 5, 4);
  write_picture(folder / "x.exr", image, {}, false);
  const Image found = read_linear_picture(folder / "x.exr");
  ASSERT_EQ(found.channels(), 3);
  EXPECT_EQ(found(4, 3, 2), image(4, 3, 2));
}

TEST(PictureFile, HalfClampsWhatItCannotHold) {
  TempFolder folder;
  Image image(2, 2, 3, 1.0F);
  image(0, 0, 0) = 1e6F;
  image(1, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  image(0, 1, 2) = std::numeric_limits<float>::infinity();
  write_picture(folder / "x.exr", image);
  const Image found = read_linear_picture(folder / "x.exr");
  EXPECT_EQ(found(0, 0, 0), 65504.0F);
  EXPECT_EQ(found(1, 0, 1), 0.0F);
  EXPECT_EQ(found(0, 1, 2), 65504.0F);
  EXPECT_EQ(found(1, 1, 0), 1.0F);
}

TEST(PictureFile, HdrKeepsRgbePrecision) {
  TempFolder folder;
  Image image = light(40, 20, 3);
  image(0, 0, 0) = -5.0F;
  write_picture(folder / "x.hdr", image);
  const Image found = read_linear_picture(folder / "x.hdr");
  ASSERT_TRUE(found.same_size(image));
  EXPECT_EQ(found(0, 0, 0), 0.0F);
  for (int y = 0; y < 20; ++y) {
    for (int x = 1; x < 40; ++x) {
      const float* expected = image.pixel(x, y);
      const float top = std::max({expected[0], expected[1], expected[2]});
      // The shared exponent leaves 8 bits for the largest channel: steps of at most 1/128 of it.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found(x, y, c), expected[c], top / 128.0F);
    }
  }
  expect_error(ExitCode::kUsage, {"1 channels"}, [&] { write_picture(folder / "y.hdr", light(4, 4, 1)); });
}

EnvMap marked_map() {  // a red lamp at camera right
  EnvMap map(64, 32);
  for (float& value : map.radiance().values()) value = 0.5F;
  map.radiance()(16, 16, 0) = 20.0F;
  return map;
}

TEST(PictureFile, EnvMapRoundTripInEveryOrientation) {
  TempFolder folder;
  const EnvMap map = marked_map();
  for (const char* name : {"x.exr", "x.hdr"}) {
    for (const Orientation o : {Orientation::kOpenExr, Orientation::kThree, Orientation::kDebevec}) {
      write_env_map(folder / name, map, o);
      // Values are exact in half; RGBE rounds 0.5 beside 20 down by up to 20/256.
      expect_relative(read_env_map(folder / name, o).radiance(), map.radiance(),
                      std::string(name) == "x.exr" ? 0.0F : 0.16F);
      // Read without rolling back, the lamp stands W/4 per quarter further right.
      const int column = (16 + 16 * static_cast<int>(o)) % 64;
      EXPECT_NEAR(read_linear_picture(folder / name)(column, 16, 0), 20.0F, 0.2F);
    }
  }
}

TEST(PictureFile, EnvMapSaysWhatItIs) {
  TempFolder folder;
  write_env_map(folder / "x.exr", marked_map(), Orientation::kOpenExr, {{"faceprobe:version", "9.8.7"}});
  const Bytes bytes = slurp(folder / "x.exr");
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  // OpenEXR's `envmap` attribute: name, type, 4-byte size 1, value 0 = lat-long.
  EXPECT_NE(text.find(std::string("envmap\0envmap\0\1\0\0\0\0", 19)), std::string::npos);
  EXPECT_NE(text.find("chromaticities"), std::string::npos);
  EXPECT_NE(text.find("9.8.7"), std::string::npos);
  const Header header = peek_header(bytes, "x.exr");
  EXPECT_EQ(header.bits, 16);
  EXPECT_EQ(header.width, 64);
}

TEST(PictureFile, EnvMapMustBeTwiceAsWide) {
  TempFolder folder;
  write_picture(folder / "x.exr", light(30, 20, 3));
  expect_error(ExitCode::kInput, {"30 x 20", "twice as wide"}, [&] { read_env_map(folder / "x.exr"); });
}

TEST(PictureFile, GreyEnvMapIsReadAsColour) {
  TempFolder folder;
  const Image grey = light(8, 4, 1);
  write_picture(folder / "x.exr", grey, {}, false);
  const EnvMap map = read_env_map(folder / "x.exr");
  for (int c = 0; c < 3; ++c) EXPECT_EQ(map.radiance()(5, 2, c), grey(5, 2));
}

TEST(PictureFile, PngOfLightAndOfCodes) {
  TempFolder folder;
  const ByteImage codes = gradient(50, 30, 3);
  write_picture(folder / "codes.png", codes, {{"Description", "a test"}});
  write_picture(folder / "light.png", decode_srgb(codes));
  for (const char* name : {"codes.png", "light.png"}) {
    const auto reader = OIIO::ImageInput::open((folder / name).string());
    ASSERT_TRUE(reader);
    ByteImage found(50, 30, 3);
    ASSERT_TRUE(reader->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, found.data()));
    EXPECT_EQ(found, codes) << name;
  }
}

TEST(PictureFile, APngWithinATextIsTheFile) {
  ByteImage image(5, 3, 4);
  for (std::size_t i = 0; i < image.values().size(); ++i) image.data()[i] = static_cast<std::uint8_t>(4 * i);
  const TempFolder folder;
  write_picture(folder / "a.png", image);
  const std::vector<std::byte> file = read_file(folder / "a.png", 1 << 20);
  const std::string text = png_data_uri(image);
  const std::string head = "data:image/png;base64,";
  ASSERT_EQ(text.substr(0, head.size()), head);
  // RFC 4648: six bits a character, filled up to four characters.
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text.substr(head.size())) {
    if (c == '=') break;
    const std::size_t value = digits.find(c);
    ASSERT_NE(value, std::string::npos);
    bits = (bits << 6) | static_cast<unsigned>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<std::byte>((bits >> count) & 0xFFU));
    }
  }
  EXPECT_EQ(bytes, file);
}

TEST(PictureFile, PngAlphaStaysProportional) {
  TempFolder folder;
  Image image(2, 1, 4, 0.5F);
  image(1, 0, 3) = 1.0F;
  write_picture(folder / "x.png", image);
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  const auto reader = OIIO::ImageInput::open((folder / "x.png").string(), &config);
  ASSERT_TRUE(reader);
  ByteImage found(2, 1, 4);
  ASSERT_TRUE(reader->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, found.data()));
  EXPECT_EQ(found(0, 0, 3), 128);
  EXPECT_EQ(found(0, 0, 0), 188);  // sRGB code of linear 0.5, not divided by alpha
}

TEST(PictureFile, PreviewPutsTheBrightTenthAtItsLevel) {
  TempFolder folder;
  EnvMap map(64, 32);
  for (std::size_t i = 0; i < map.radiance().values().size(); ++i) {
    map.radiance().data()[i] = 0.001F * static_cast<float>(i / 3 % 1000);
  }
  write_env_map(folder / "x.png", map);
  const auto reader = OIIO::ImageInput::open((folder / "x.png").string());
  ASSERT_TRUE(reader);
  std::vector<std::uint8_t> found(64 * 32 * 3);
  ASSERT_TRUE(reader->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, found.data()));
  std::nth_element(found.begin(), found.begin() + found.size() * 9 / 10, found.end());
  // sRGB code of 0.6 is 203; the picture has about one level per code there.
  EXPECT_NEAR(found[found.size() * 9 / 10], 203, 2);
}

TEST(PictureFile, WrongUseIsSaid) {
  TempFolder folder;
  expect_error(ExitCode::kUsage, {"x.jpg", ".exr"}, [&] { write_picture(folder / "x.jpg", light(4, 4, 3)); });
  expect_error(ExitCode::kUsage, {"x.bmp"}, [&] { write_env_map(folder / "x.bmp", marked_map()); });
  expect_error(ExitCode::kUsage, {"2 channels"}, [&] { write_picture(folder / "x.exr", light(4, 4, 2)); });
  expect_error(ExitCode::kOutput, {"No such file or directory"},
               [&] { write_picture(folder / "none/x.exr", light(4, 4, 3)); });
  write_bytes("png", folder / "x.png", gradient(4, 4, 3));
  expect_error(ExitCode::kInput, {"png file", ".exr or .hdr"}, [&] { read_linear_picture(folder / "x.png"); });
  EXPECT_TRUE(fs::exists(folder / "x.png"));
}

TEST(PictureFile, NamesThatPicturesAreWrittenTo) {
  for (const char* name : {"a.png", "a.EXR", "folder.jpg/a.Hdr"}) EXPECT_TRUE(is_picture_file(name)) << name;
  for (const char* name : {"", "a", "png", "a.jpg", "a.png/", "a.exr.zip", "folder.png/a"})
    EXPECT_FALSE(is_picture_file(name)) << name;
}

}  // namespace
}  // namespace faceprobe::io
