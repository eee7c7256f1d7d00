// What EXIF says: focal length, and the orientation in PNG and WebP chunks, made by hand.

#include "faceprobe/core/color.h"
#include "faceprobe/io/photo.h"
#include "fixtures.h"
#include "io/crc32.h"

#include <cmath>

namespace faceprobe::io {
namespace {

using namespace testing;

// A TIFF block with the orientation tag alone, as EXIF holds it.
Bytes exif_block(int orientation) {
  Bytes b = to_bytes("II");
  put_little(b, 42, 2);
  put_little(b, 8, 4);
  put_little(b, 1, 2);
  put_little(b, 0x0112, 2);
  put_little(b, 3, 2);
  put_little(b, 1, 4);
  put_little(b, static_cast<std::uint64_t>(orientation), 4);
  put_little(b, 0, 4);
  return b;
}

Bytes png_with_exif(const Bytes& png, const Bytes& exif) {
  Bytes chunk = to_bytes("eXIf");
  chunk.insert(chunk.end(), exif.begin(), exif.end());
  Bytes whole;
  put_big(whole, exif.size(), 4);
  whole.insert(whole.end(), chunk.begin(), chunk.end());
  put_big(whole, crc32(chunk), 4);
  constexpr std::ptrdiff_t kAfterHeader = 8 + 25;  // signature and IHDR
  Bytes result = png;
  result.insert(result.begin() + kAfterHeader, whole.begin(), whole.end());
  return result;
}

// A simple lossless WebP turned into an extended one with an EXIF chunk.
Bytes webp_with_exif(const Bytes& simple, const Bytes& exif, int width, int height) {
  Bytes body = to_bytes("WEBPVP8X");
  put_little(body, 10, 4);
  put_little(body, 0x08, 4);
  put_little(body, static_cast<std::uint64_t>(width - 1), 3);
  put_little(body, static_cast<std::uint64_t>(height - 1), 3);
  body.insert(body.end(), simple.begin() + 12, simple.end());
  put_text(body, "EXIF");
  put_little(body, exif.size(), 4);
  body.insert(body.end(), exif.begin(), exif.end());
  Bytes whole = to_bytes("RIFF");
  put_little(whole, body.size(), 4);
  whole.insert(whole.end(), body.begin(), body.end());
  return whole;
}

// Red left, blue right, 16 x 24 px; orientation 8 turns it by a quarter.
ByteImage red_blue() {
  ByteImage image(16, 24, 3, 0);
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 16; ++x) image(x, y, x < 8 ? 0 : 2) = 255;
  }
  return image;
}

void expect_turned(const Photo& photo) {
  EXPECT_EQ(photo.exif_orientation, 8);
  ASSERT_EQ(photo.linear.width(), 24);
  ASSERT_EQ(photo.linear.height(), 16);
  // 8: the stored right side is the upright top. 0.05: the WebP writer's YUV rounding at full light.
  EXPECT_NEAR(photo.linear(4, 2, 2), 1.0F, 0.05F);
  EXPECT_NEAR(photo.linear(4, 13, 0), 1.0F, 0.05F);
  EXPECT_NEAR(photo.linear(4, 13, 2), 0.0F, 0.05F);
}

TEST(Metadata, PngOrientation) {
  TempFolder folder;
  write_bytes("png", folder / "x.png", red_blue());
  spit(folder / "x.png", png_with_exif(slurp(folder / "x.png"), exif_block(8)));
  expect_turned(load_photo(folder / "x.png"));
}

TEST(Metadata, WebpOrientation) {
  TempFolder folder;
  write_bytes("webp", folder / "x.webp", red_blue());
  const Bytes simple = slurp(folder / "x.webp");
  ASSERT_EQ(std::to_integer<char>(simple[15]), 'L');
  spit(folder / "x.webp", webp_with_exif(simple, exif_block(8), 16, 24));
  expect_turned(load_photo(folder / "x.webp"));
}

TEST(Metadata, NonsenseOrientationCountsAsUpright) {
  TempFolder folder;
  write_bytes("png", folder / "x.png", red_blue());
  spit(folder / "x.png", png_with_exif(slurp(folder / "x.png"), exif_block(77)));
  const Photo photo = load_photo(folder / "x.png");
  EXPECT_EQ(photo.exif_orientation, 1);
  EXPECT_EQ(photo.linear.width(), 16);
}

TEST(Metadata, FocalLengthFrom35mmEquivalent) {
  TempFolder folder;
  OIIO::ParamValueList attributes;
  attributes.attribute("Exif:FocalLengthIn35mmFilm", 50);
  // A picture of the film's own shape: 50 mm across 36 mm of film is 50 / 36 of the width.
  write_bytes("jpeg", folder / "x.jpg", gradient(72, 48, 3), attributes);
  const Photo photo = load_photo(folder / "x.jpg");
  ASSERT_TRUE(photo.focal_px);
  EXPECT_NEAR(*photo.focal_px, 72 * 50 / 36.0, 0.01);  // the diagonal is rounded to 0.01 of 43 mm
}

TEST(Metadata, FocalLengthFromTheSensorPitch) {
  TempFolder folder;
  OIIO::ParamValueList attributes;
  attributes.attribute("Exif:FocalLength", 10.0F);
  attributes.attribute("Exif:FocalPlaneXResolution", 200.0F);  // px per cm
  attributes.attribute("Exif:FocalPlaneResolutionUnit", 3);
  attributes.attribute("Exif:PixelXDimension", 144);  // taken twice as large
  write_bytes("jpeg", folder / "x.jpg", gradient(72, 48, 3), attributes);
  const Photo photo = load_photo(folder / "x.jpg");
  ASSERT_TRUE(photo.focal_px);
  EXPECT_NEAR(*photo.focal_px, 100.0, 0.1);  // 10 mm x 20 px/mm, halved
}

TEST(Metadata, NoFocalLengthRatherThanAWrongOne) {
  TempFolder folder;
  write_bytes("jpeg", folder / "plain.jpg", gradient(72, 48, 3));
  EXPECT_FALSE(load_photo(folder / "plain.jpg").focal_px);
  OIIO::ParamValueList attributes;
  attributes.attribute("Exif:FocalLengthIn35mmFilm", 60000);
  write_bytes("jpeg", folder / "wild.jpg", gradient(72, 48, 3), attributes);
  EXPECT_FALSE(load_photo(folder / "wild.jpg").focal_px);
}

}  // namespace
}  // namespace faceprobe::io
