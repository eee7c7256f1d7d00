// From code values to light: orientation, depth, grey, alpha, clipping, and the formats.

#include "faceprobe/io/photo.h"

#include "faceprobe/core/color.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/picture_file.h"
#include "fixtures.h"

#include <cmath>
#include <limits>

// The HEVC encoder that one fixture uses keeps an allocation; without LeakSanitizer nobody calls this.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libx265\n"; }

namespace faceprobe::io {
namespace {

using namespace testing;
namespace fs = std::filesystem;

float largest_difference(const Image& a, const Image& b) {
  if (!a.same_size(b)) return std::numeric_limits<float>::infinity();
  float largest = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) largest = std::max(largest, std::abs(a.data()[i] - b.data()[i]));
  return largest;
}

// How a camera stores an upright scene under orientation o: the definition in EXIF 2.32, which side of the scene the stored
// row 0 and column 0 are. Written as the table there, not as the code under test computes it.
ByteImage stored_as(const ByteImage& upright, int orientation) {
  const int w = upright.width();
  const int h = upright.height();
  const bool turned = orientation >= 5;
  ByteImage stored(turned ? h : w, turned ? w : h, 3);
  for (int row = 0; row < stored.height(); ++row) {
    for (int col = 0; col < stored.width(); ++col) {
      int x = 0;
      int y = 0;
      switch (orientation) {
        case 1: x = col, y = row; break;                  // top, left
        case 2: x = w - 1 - col, y = row; break;          // top, right
        case 3: x = w - 1 - col, y = h - 1 - row; break;  // bottom, right
        case 4: x = col, y = h - 1 - row; break;          // bottom, left
        case 5: x = row, y = col; break;                  // left, top
        case 6: x = w - 1 - row, y = col; break;          // right, top
        case 7: x = w - 1 - row, y = h - 1 - col; break;  // right, bottom
        case 8: x = row, y = h - 1 - col; break;          // left, bottom
        default: break;
      }
      std::copy_n(upright.pixel(x, y), 3, stored.pixel(col, row));
    }
  }
  return stored;
}

TEST(PhotoTest, AllOrientationsGiveTheSamePicture) {
  TempFolder folder;
  const ByteImage scene = quadrants();
  const Image expected = decode_srgb(scene);
  for (const char* format : {"jpeg", "tiff"}) {  // PNG and WebP: metadata_test.cpp, whose chunks are made by hand
    for (int orientation = 1; orientation <= 8; ++orientation) {
      OIIO::ParamValueList attributes;
      attributes.attribute("Orientation", orientation);
      const fs::path path = folder / "x";
      write_bytes(format, path, stored_as(scene, orientation), attributes);
      const Photo photo = load_photo(path);
      EXPECT_EQ(photo.exif_orientation, orientation) << format;
      // JPEG: two codes at the brightest level, where a code is worth 0.9 % of light. TIFF keeps every bit.
      const float tolerance = std::string(format) == "jpeg" ? 0.02F : 0.0F;
      EXPECT_LE(largest_difference(photo.linear, expected), tolerance) << format << " " << orientation;
    }
  }
}

TEST(PhotoTest, FlagsAreTurnedWithThePicture) {
  TempFolder folder;
  ByteImage scene(20, 10, 3, 100);
  scene(3, 2, 0) = 255;
  OIIO::ParamValueList attributes;
  attributes.attribute("Orientation", 6);
  write_bytes("tiff", folder / "x.tif", stored_as(scene, 6), attributes);
  const Photo photo = load_photo(folder / "x.tif");
  ASSERT_EQ(photo.clipped.width(), 20);
  EXPECT_EQ(photo.clipped(3, 2), kClippedRed);
  EXPECT_EQ(std::count(photo.clipped.values().begin(), photo.clipped.values().end(), 0), 199);
}

// More rows than are decoded at a time, and not a multiple of them.
TEST(PhotoTest, LosslessFormatsKeepEveryCode) {
  TempFolder folder;
  const ByteImage image = gradient(37, 101, 3);
  for (const char* format : {"png", "tiff"}) {
    write_bytes(format, folder / "x", image);
    const Photo photo = load_photo(folder / "x");
    EXPECT_EQ(photo.format, format);
    EXPECT_EQ(photo.bits_per_channel, 8);
    EXPECT_FALSE(photo.grey);
    EXPECT_EQ(largest_difference(photo.linear, decode_srgb(image)), 0.0F) << format;
  }
}

TEST(PhotoTest, TiledTiff) {
  TempFolder folder;
  const ByteImage image = gradient(100, 70, 3);
  OIIO::ImageSpec spec(100, 70, 3, OIIO::TypeDesc::UINT8);
  spec.tile_width = spec.tile_height = 32;
  write_with("tiff", folder / "x.tif", spec, OIIO::TypeDesc::UINT8, image.data());
  EXPECT_EQ(largest_difference(load_photo(folder / "x.tif").linear, decode_srgb(image)), 0.0F);
}

TEST(PhotoTest, APictureInMemoryIsAsIfRead) {
  ByteImage image(3, 1, 3, 80);
  image(1, 0, 0) = 255;
  image(2, 0, 2) = 254;
  const Photo photo = photo_from_srgb(image);
  EXPECT_EQ(photo.linear, decode_srgb(image));
  EXPECT_EQ(photo.clipped(0, 0), 0);
  EXPECT_EQ(photo.clipped(1, 0), kClippedRed);
  EXPECT_EQ(photo.clipped(2, 0), kClippedBlue);
  EXPECT_FALSE(photo.grey);
  EXPECT_TRUE(photo_from_srgb(ByteImage(2, 2, 3, 90)).grey);
  EXPECT_THROW(photo_from_srgb(ByteImage(2, 2, 1)), std::invalid_argument);
}

TEST(PhotoTest, ContentDecidesNotTheExtension) {
  TempFolder folder;
  const ByteImage image = gradient(24, 16, 3);
  write_bytes("tiff", folder / "x.jpg", image);
  write_bytes("jpeg", folder / "x.exr", image);
  const Photo tiff = load_photo(folder / "x.jpg");
  EXPECT_EQ(tiff.format, "tiff");
  EXPECT_EQ(largest_difference(tiff.linear, decode_srgb(image)), 0.0F);
  EXPECT_EQ(load_photo(folder / "x.exr").format, "jpeg");
}

TEST(PhotoTest, SixteenBitsAgreeWithEight) {
  TempFolder folder;
  const ByteImage image = gradient(64, 16, 3);
  std::vector<std::uint16_t> wide(image.values().size());
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = static_cast<std::uint16_t>(image.data()[i] * 257);
  const OIIO::ImageSpec spec(64, 16, 3, OIIO::TypeDesc::UINT16);
  for (const char* format : {"png", "tiff"}) {
    write_with(format, folder / "x", spec, OIIO::TypeDesc::UINT16, wide.data());
    const Photo photo = load_photo(folder / "x");
    EXPECT_EQ(photo.bits_per_channel, 16);
    EXPECT_LE(largest_difference(photo.linear, decode_srgb(image)), 1e-6F);  // the same code up to float rounding
    EXPECT_NE(photo.clipped.values().size(), 0U);
    for (int x = 0; x < 64; ++x) {
      const bool top = image(x, 5, 1) == 255;  // 254 widened is not clipped
      EXPECT_EQ((photo.clipped(x, 5) & kClippedGreen) != 0, top) << x;
    }
  }
}

TEST(PhotoTest, ClippingIsReadFromTheCodes) {
  TempFolder folder;
  ByteImage image(5, 1, 3, 100);
  image(0, 0, 0) = 253;
  image(1, 0, 0) = 254;
  image(2, 0, 1) = 255;
  std::fill_n(image.pixel(3, 0), 3, std::uint8_t{255});
  write_bytes("png", folder / "x.png", image);
  const Photo photo = load_photo(folder / "x.png");
  EXPECT_EQ(photo.clipped(0, 0), 0);
  EXPECT_EQ(photo.clipped(1, 0), kClippedRed);
  EXPECT_EQ(photo.clipped(2, 0), kClippedGreen);
  EXPECT_EQ(photo.clipped(3, 0), kClippedRed | kClippedGreen | kClippedBlue);
  EXPECT_EQ(photo.clipped(4, 0), 0);
}

TEST(PhotoTest, Grey) {
  TempFolder folder;
  const ByteImage one = gradient(40, 20, 1);
  for (const char* format : {"png", "tiff", "jpeg"}) {
    write_bytes(format, folder / "x", one);
    const Photo photo = load_photo(folder / "x");
    EXPECT_TRUE(photo.grey) << format;
    EXPECT_EQ(photo.linear.channels(), 3);
    for (int c = 1; c < 3; ++c) EXPECT_EQ(photo.linear(7, 7, c), photo.linear(7, 7, 0));
  }
  ByteImage three(40, 20, 3);
  for (std::size_t i = 0; i < three.values().size(); ++i) three.data()[i] = one.data()[i / 3];
  for (const char* format : {"png", "jpeg"}) {
    write_bytes(format, folder / "x", three);
    EXPECT_TRUE(load_photo(folder / "x").grey) << format;
  }
  three(39, 19, 2) = static_cast<std::uint8_t>(three(39, 19, 2) + 2);  // one pixel of colour is colour
  write_bytes("png", folder / "x", three);
  EXPECT_FALSE(load_photo(folder / "x").grey);
}

TEST(PhotoTest, TransparentPixelsAreMarkedAndKeepTheirColour) {
  TempFolder folder;
  ByteImage image(3, 1, 4, 200);
  image(0, 0, 3) = 255;
  image(1, 0, 3) = 128;
  image(2, 0, 3) = 0;
  for (const char* format : {"png", "tiff"}) {
    write_bytes(format, folder / "x", image);
    const Photo photo = load_photo(folder / "x");
    EXPECT_EQ(photo.clipped(0, 0), 0) << format;
    EXPECT_EQ(photo.clipped(1, 0), kTransparent) << format;
    EXPECT_EQ(photo.clipped(2, 0), kTransparent) << format;
    EXPECT_NEAR(photo.linear(1, 0, 1), linear_from_srgb(200 / 255.0F), 1e-6F) << format << ": multiplied by alpha";
  }
  ByteImage grey_alpha(2, 1, 2, 90);
  grey_alpha(0, 0, 1) = 255;
  write_bytes("png", folder / "x", grey_alpha);
  const Photo photo = load_photo(folder / "x");
  EXPECT_TRUE(photo.grey);
  EXPECT_EQ(photo.clipped(0, 0), 0);
  EXPECT_EQ(photo.clipped(1, 0), kTransparent);
}

TEST(PhotoTest, ExrAndHdrAreLinearAlready) {
  TempFolder folder;
  Image image(6, 3, 3, 0.25F);
  image(1, 1, 0) = 40.0F;
  for (const char* name : {"x.exr", "x.hdr"}) {
    write_picture(folder / name, image);
    const Photo photo = load_photo(folder / name);
    EXPECT_EQ(photo.colour_space, "linear");
    EXPECT_TRUE(photo.warnings.empty());
    EXPECT_EQ(photo.linear(0, 0, 0), 0.25F);
    EXPECT_EQ(photo.linear(1, 1, 0), 40.0F);
    EXPECT_EQ(photo.clipped(1, 1), 0);  // no top of the range to clip at
  }
}

TEST(PhotoTest, ValuesThatAreNotLightAreCountedAndZero) {
  TempFolder folder;
  Image image(4, 4, 3, 0.5F);
  image(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  image(1, 0, 1) = std::numeric_limits<float>::infinity();
  image(2, 0, 2) = -3.0F;
  image(3, 0, 2) = 1e30F;
  const OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeDesc::FLOAT);
  write_with("openexr", folder / "x.exr", spec, OIIO::TypeDesc::FLOAT, image.data());
  const Photo photo = load_photo(folder / "x.exr");
  for (const float value : photo.linear.values()) EXPECT_TRUE(std::isfinite(value) && value >= 0);
  EXPECT_EQ(photo.linear(0, 0, 0), 0.0F);
  EXPECT_EQ(photo.linear(3, 0, 2), 1e30F);
  ASSERT_EQ(photo.warnings.size(), 2U);
  EXPECT_EQ(photo.warnings[0].substr(0, 2), "2 ");
  EXPECT_EQ(photo.warnings[1].substr(0, 2), "1 ");
}

TEST(PhotoTest, CarriesTheChecksumOfTheFile) {
  TempFolder folder;
  write_bytes("png", folder / "x.png", gradient(8, 8, 3));
  const Bytes bytes = slurp(folder / "x.png");
  EXPECT_EQ(load_photo(folder / "x.png").sha256, sha256_hex(bytes.data(), bytes.size()));
}

// The middle of each quadrant, away from the edges that halved chroma smears.
void expect_quadrants(const Photo& photo, float tolerance) {
  const Image expected = decode_srgb(quadrants());
  ASSERT_TRUE(photo.linear.same_size(expected));
  for (const auto& [x, y] : {std::pair{8, 12}, {24, 12}, {8, 36}, {24, 36}}) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(photo.linear(x, y, c), expected(x, y, c), tolerance);
  }
}

TEST(PhotoTest, Webp) {
  TempFolder folder;
  write_bytes("webp", folder / "x", quadrants());
  const Photo photo = load_photo(folder / "x");
  EXPECT_EQ(photo.format, "webp");
  // OpenImageIO's writer goes through 8-bit limited-range YUV: one step of 1/219 in each of three planes, 2 codes here,
  // where a code is worth up to 0.007 of light.
  expect_quadrants(photo, 0.02F);
}

TEST(PhotoTest, HeicIsReadWhereItCanBeWritten) {
  TempFolder folder;
  const ByteImage scene = quadrants();
  const fs::path path = folder / "x.heic";
  const std::unique_ptr<OIIO::ImageOutput> writer = OIIO::ImageOutput::create("heif");
  OIIO::ImageSpec spec(32, 48, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Orientation", 6);  // in the EXIF block only, where HEIF says it has no effect
  // OpenImageIO 2.4's writer reads a row more than it is given.
  std::vector<std::uint8_t> padded(scene.values().begin(), scene.values().end());
  padded.resize(padded.size() + 2 * 32 * 3);
  if (!writer || !writer->open(path.string(), spec) || !writer->write_image(OIIO::TypeDesc::UINT8, padded.data()) ||
      !writer->close()) {
    if (writer) writer->geterror();
    OIIO::geterror();
    GTEST_SKIP() << "no HEVC encoder here";
  }
  const Photo photo = load_photo(path);
  EXPECT_EQ(photo.format, "heif");
  expect_quadrants(photo, 0.05F);  // HEVC at the writer's default quality
}

}  // namespace
}  // namespace faceprobe::io
