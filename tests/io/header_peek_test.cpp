// Handmade headers of every format: the numbers the specifications put there are the numbers we read.

#include "io/header_peek.h"

#include "fixtures.h"

namespace faceprobe::io {
namespace {

using namespace testing;

Bytes png_header(std::uint32_t width, std::uint32_t height, int bits, int colour_type) {
  Bytes b = to_bytes("\x89PNG\r\n\x1a\n");
  put_big(b, 13, 4);
  put_text(b, "IHDR");
  put_big(b, width, 4);
  put_big(b, height, 4);
  put_big(b, static_cast<std::uint64_t>(bits), 1);
  put_big(b, static_cast<std::uint64_t>(colour_type), 1);
  return b;
}

// SOI, SOFn, then `scans` empty scans, EOI.
Bytes jpeg_header(int kind, int width, int height, int components, int scans) {
  Bytes b;
  put_big(b, 0xFFD8, 2);
  put_big(b, static_cast<std::uint64_t>(0xFFC0 + kind), 2);
  put_big(b, static_cast<std::uint64_t>(8 + 3 * components), 2);
  put_big(b, 8, 1);
  put_big(b, static_cast<std::uint64_t>(height), 2);
  put_big(b, static_cast<std::uint64_t>(width), 2);
  put_big(b, static_cast<std::uint64_t>(components), 1);
  for (int i = 0; i < components; ++i) put_big(b, static_cast<std::uint64_t>(((i + 1) << 16) | 0x1100), 3);
  for (int i = 0; i < scans; ++i) {
    put_big(b, 0xFFDA, 2);
    put_big(b, 8, 2);
    put_big(b, 0x010100003F00, 6);
    put_big(b, 0x12FF00FFD05A, 6);  // data with a stuffed zero and a restart marker: neither ends the scan
  }
  put_big(b, 0xFFD9, 2);
  return b;
}

Bytes tiff_header(bool little, const std::vector<std::array<std::uint64_t, 3>>& tags) {  // tag, type, value
  Bytes b = to_bytes(little ? "II" : "MM");
  const auto put = [&](std::uint64_t value, int count) {
    little ? put_little(b, value, count) : put_big(b, value, count);
  };
  put(42, 2);
  put(8, 4);
  put(tags.size(), 2);
  for (const auto& [tag, type, value] : tags) {
    put(tag, 2);
    put(type, 2);
    put(1, 4);
    if (type == 3) {
      put(value, 2);
      put(0, 2);
    } else {
      put(value, 4);
    }
  }
  put(0, 4);
  return b;
}

void put_exr_attribute(Bytes& b, std::string_view name, std::string_view type, const Bytes& value) {
  put_text(b, name);
  put_big(b, 0, 1);
  put_text(b, type);
  put_big(b, 0, 1);
  put_little(b, value.size(), 4);
  b.insert(b.end(), value.begin(), value.end());
}

Bytes exr_header(int x0, int y0, int x1, int y1, int channels, std::uint32_t flags = 0) {
  Bytes b;
  put_little(b, 20000630, 4);
  put_little(b, 2 | flags, 4);
  Bytes list;
  for (int i = 0; i < channels; ++i) {
    list.push_back(static_cast<std::byte>('A' + i % 26));
    put_little(list, 0, 1);
    put_little(list, 1, 4);  // half
    put_little(list, 0, 4);
    put_little(list, 1, 4);
    put_little(list, 1, 4);
  }
  put_little(list, 0, 1);
  put_exr_attribute(b, "channels", "chlist", list);
  put_exr_attribute(b, "compression", "compression", {std::byte{3}});
  Bytes window;
  for (const int v : {x0, y0, x1, y1}) put_little(window, static_cast<std::uint32_t>(v), 4);
  put_exr_attribute(b, "dataWindow", "box2i", window);
  put_little(b, 0, 1);
  return b;
}

Bytes box(std::string_view type, const Bytes& payload) {
  Bytes b;
  put_big(b, payload.size() + 8, 4);
  put_text(b, type);
  b.insert(b.end(), payload.begin(), payload.end());
  return b;
}

Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes ispe(std::uint32_t width, std::uint32_t height) {
  Bytes b;
  put_big(b, 0, 4);
  put_big(b, width, 4);
  put_big(b, height, 4);
  return box("ispe", b);
}

Bytes heif_header(const Bytes& properties, std::string_view brand = "heic") {
  Bytes brands = to_bytes(brand);
  put_big(brands, 0, 4);
  put_text(brands, brand);
  Bytes version;
  put_big(version, 0, 4);
  return joined({box("ftyp", brands), box("meta", joined({version, box("iprp", box("ipco", properties))}))});
}

TEST(HeaderPeek, Png) {
  const Header h = peek_header(png_header(640, 480, 16, 6), "x");
  EXPECT_EQ(h.format, "png");
  EXPECT_EQ(h.width, 640);
  EXPECT_EQ(h.height, 480);
  EXPECT_EQ(h.bits, 16);
  EXPECT_EQ(h.channels, 4);
  EXPECT_EQ(peek_header(png_header(1, 1, 8, 0), "x").channels, 1);
  EXPECT_EQ(peek_header(png_header(1, 1, 8, 4), "x").channels, 2);
  EXPECT_EQ(peek_header(png_header(1, 1, 8, 2), "x").channels, 3);
  EXPECT_THROW(peek_header(png_header(1, 1, 8, 5), "x"), Error);
  EXPECT_THROW(peek_header(png_header(0, 1, 8, 2), "x"), Error);
  EXPECT_THROW(peek_header(png_header(1, 1, 7, 2), "x"), Error);
}

TEST(HeaderPeek, JpegCountsScansAndFindsItsEnd) {
  const Header h = peek_header(jpeg_header(2, 300, 200, 3, 7), "x");
  EXPECT_EQ(h.format, "jpeg");
  EXPECT_EQ(h.width, 300);
  EXPECT_EQ(h.height, 200);
  EXPECT_EQ(h.channels, 3);
  EXPECT_EQ(h.scans, 7);
  EXPECT_TRUE(h.damage.empty());
  Bytes cut = jpeg_header(0, 300, 200, 1, 1);
  cut.resize(cut.size() - 2);
  EXPECT_NE(peek_header(cut, "x").damage.find("cut short"), std::string::npos);
}

TEST(HeaderPeek, JpegSecondFrameHeaderCannotHideALargerOne) {
  Bytes both = jpeg_header(0, 8, 8, 3, 0);
  both.resize(both.size() - 2);
  const Bytes second = jpeg_header(2, 60000, 60000, 3, 1);
  both.insert(both.end(), second.begin() + 2, second.end());
  EXPECT_EQ(peek_header(both, "x").width, 60000);
}

TEST(HeaderPeek, JpegKindsThatAreRefused) {
  expect_error(ExitCode::kInput, {"x.jpg", "CMYK", "RGB"}, [] { peek_header(jpeg_header(0, 8, 8, 4, 1), "x.jpg"); });
  expect_error(ExitCode::kInput, {"lossless"}, [] { peek_header(jpeg_header(3, 8, 8, 3, 1), "x.jpg"); });
  expect_error(ExitCode::kInput, {"2 components"}, [] { peek_header(jpeg_header(0, 8, 8, 2, 1), "x.jpg"); });
  expect_error(ExitCode::kInput, {"0 x 8"}, [] { peek_header(jpeg_header(0, 0, 8, 3, 1), "x.jpg"); });
}

TEST(HeaderPeek, TiffInBothByteOrders) {
  for (const bool little : {true, false}) {
    const Header h = peek_header(
        tiff_header(little,
                    {{256, 4, 5000}, {257, 3, 3000}, {258, 3, 16}, {262, 3, 2}, {277, 3, 3}, {322, 3, 64}, {323, 3, 32}}),
        "x");
    EXPECT_EQ(h.format, "tiff");
    EXPECT_EQ(h.width, 5000);
    EXPECT_EQ(h.height, 3000);
    EXPECT_EQ(h.bits, 16);
    EXPECT_EQ(h.channels, 3);
    EXPECT_EQ(h.tile_width, 64);
    EXPECT_EQ(h.tile_height, 32);
  }
}

TEST(HeaderPeek, BigTiff) {
  Bytes b = to_bytes("II");
  put_little(b, 43, 2);
  put_little(b, 8, 2);
  put_little(b, 0, 2);
  put_little(b, 16, 8);
  put_little(b, 2, 8);
  for (const std::uint64_t tag : {256U, 257U}) {
    put_little(b, tag, 2);
    put_little(b, 16, 2);  // LONG8
    put_little(b, 1, 8);
    put_little(b, 1ULL << 40, 8);
  }
  const Header h = peek_header(b, "x");
  EXPECT_GE(h.width, 1LL << 32);  // clamped so that products cannot overflow, but far over any limit
  expect_error(ExitCode::kInput, {"--max-pixels"}, [&] { check_limits(h, 100, "x", Limits{}); });
}

TEST(HeaderPeek, TiffColoursThatAreRefused) {
  const auto with_colour = [](std::uint64_t photometric) {
    return tiff_header(true, {{256, 3, 8}, {257, 3, 8}, {262, 3, photometric}});
  };
  expect_error(ExitCode::kInput, {"CMYK"}, [&] { peek_header(with_colour(5), "x.tif"); });
  expect_error(ExitCode::kInput, {"Lab"}, [&] { peek_header(with_colour(8), "x.tif"); });
  expect_error(ExitCode::kInput, {"raw sensor data"}, [&] { peek_header(with_colour(32803), "x.tif"); });
  EXPECT_NO_THROW(peek_header(with_colour(1), "x.tif"));
}

TEST(HeaderPeek, TiffDirectoriesThatLie) {
  EXPECT_THROW(peek_header(tiff_header(true, {}), "x"), Error);
  Bytes outside = to_bytes(std::string_view("II\x2a\0\xff\xff\xff\x7f", 8));
  EXPECT_THROW(peek_header(outside, "x"), Error);
  Bytes many = to_bytes(std::string_view("II\x2a\0\x08\0\0\0\xff\xff", 10));
  expect_error(ExitCode::kInput, {"65535 tags"}, [&] { peek_header(many, "x"); });
}

TEST(HeaderPeek, WebpOfAllThreeKinds) {
  const auto riff = [](std::string_view chunk, const Bytes& payload) {
    Bytes b = to_bytes("RIFF");
    put_little(b, payload.size() + 12, 4);
    put_text(b, "WEBP");
    put_text(b, chunk);
    put_little(b, payload.size(), 4);
    b.insert(b.end(), payload.begin(), payload.end());
    return b;
  };
  Bytes lossy = to_bytes(std::string_view("\0\0\0\x9d\x01\x2a", 6));
  put_little(lossy, 1000 | 0x4000, 2);  // the two upper bits are a scale, not the size
  put_little(lossy, 700, 2);
  const Header a = peek_header(riff("VP8 ", lossy), "x");
  EXPECT_EQ(a.width, 1000);
  EXPECT_EQ(a.height, 700);
  EXPECT_EQ(a.channels, 3);

  Bytes lossless = {std::byte{0x2F}};
  put_little(lossless, (1000 - 1) | ((700 - 1) << 14) | (1 << 28), 4);
  const Header b = peek_header(riff("VP8L", lossless), "x");
  EXPECT_EQ(b.width, 1000);
  EXPECT_EQ(b.height, 700);
  EXPECT_EQ(b.channels, 4);

  Bytes extended;
  put_little(extended, 0x10, 4);
  put_little(extended, 100000 - 1, 3);
  put_little(extended, 3 - 1, 3);
  const Header c = peek_header(riff("VP8X", extended), "x");
  EXPECT_EQ(c.width, 100000);
  EXPECT_EQ(c.height, 3);
  EXPECT_TRUE(c.damage.empty());
  Bytes cut = riff("VP8X", extended);
  cut[4] = std::byte{200};  // RIFF promises more than is there
  EXPECT_NE(peek_header(cut, "x").damage.find("cut short"), std::string::npos);
}

TEST(HeaderPeek, Exr) {
  Bytes b = exr_header(-10, 5, 89, 54, 3);
  b.resize(b.size() + 64);  // room for the table of chunks
  const Header h = peek_header(b, "x");
  EXPECT_EQ(h.format, "exr");
  EXPECT_EQ(h.width, 100);
  EXPECT_EQ(h.height, 50);
  EXPECT_EQ(h.channels, 3);
  EXPECT_EQ(h.bits, 16);
  EXPECT_TRUE(h.is_float);
}

TEST(HeaderPeek, ExrThatLies) {
  expect_error(ExitCode::kInput, {"deep"}, [] { peek_header(exr_header(0, 0, 9, 9, 3, 0x800), "x.exr"); });
  // Full range of a 32-bit box: its size does not fit 32 bits.
  const Bytes widest = exr_header(-2147483647 - 1, 0, 2147483647, 9, 3);
  EXPECT_EQ(peek_header(widest, "x").width, 1LL << 32);
  expect_error(ExitCode::kInput, {"--max-pixels"}, [&] { accept_header(widest, "x.exr", Limits{}); });
  expect_error(ExitCode::kInput, {"table of contents"}, [] { peek_header(exr_header(0, 0, 9, 30000, 3), "x.exr"); });
  Bytes many = exr_header(0, 0, 9, 9, 500);
  many.resize(many.size() + 64);
  expect_error(ExitCode::kInput, {"500 channels", "64"},
               [&] { check_limits(peek_header(many, "x"), 9000, "x.exr", Limits{}); });
}

TEST(HeaderPeek, Radiance) {
  const Header h = peek_header(to_bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nSOFTWARE=x\n\n-Y 64 +X 128\n"), "x");
  EXPECT_EQ(h.format, "hdr");
  EXPECT_EQ(h.width, 128);
  EXPECT_EQ(h.height, 64);
  expect_error(ExitCode::kInput, {"XYZE"},
               [] { peek_header(to_bytes("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 64 +X 128\n"), "x"); });
  expect_error(ExitCode::kInput, {"resolution line"}, [] { peek_header(to_bytes("#?RGBE\n\n+X 64 -Y 128\n"), "x"); });
  EXPECT_THROW(peek_header(to_bytes("#?RGBE\n\n-Y 99999999999999999999 +X 1\n"), "x"), Error);
  EXPECT_THROW(peek_header(to_bytes("#?RADIANCE\nno end"), "x"), Error);
}

TEST(HeaderPeek, HeifTakesItsLargestItem) {
  const Header h = peek_header(heif_header(joined({ispe(320, 240), ispe(4032, 3024), ispe(512, 512)})), "x");
  EXPECT_EQ(h.format, "heif");
  EXPECT_EQ(h.width, 4032);
  EXPECT_EQ(h.height, 3024);
  expect_error(ExitCode::kInput, {"does not tell its size"}, [] { peek_header(heif_header({}), "x"); });
  expect_error(ExitCode::kInput, {"video"}, [] { peek_header(heif_header(ispe(8, 8), "isom"), "x.mp4"); });
  Bytes flood;
  for (int i = 0; i < 5000; ++i) flood = joined({box("free", {}), flood.size() > 40000 ? Bytes{} : flood});
  for (int i = 0; i < 5000; ++i) put_big(flood, 0x0000000866726565, 8);
  expect_error(ExitCode::kInput, {"4000 boxes"}, [&] { peek_header(heif_header(flood), "x"); });
}

TEST(HeaderPeek, AnythingElseIsNamedAndRefused) {
  expect_error(ExitCode::kInput, {"notes.txt", "JPEG, PNG"}, [] { peek_header(to_bytes("hello, world"), "notes.txt"); });
  expect_error(ExitCode::kInput, {"x.jpg is empty"}, [] { peek_header({}, "x.jpg"); });
}

// Every prefix of every header is either read or refused, never read beyond its end (the sanitizers watch).
TEST(HeaderPeek, PrefixesAreSafe) {
  const std::vector<Bytes> headers = {png_header(64, 64, 8, 2),
                                      jpeg_header(2, 64, 64, 3, 3),
                                      tiff_header(true, {{256, 3, 8}, {257, 3, 8}}),
                                      exr_header(0, 0, 9, 9, 3),
                                      to_bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n"),
                                      heif_header(ispe(64, 64))};
  for (const Bytes& header : headers) {
    int refused = 0;
    for (std::size_t size = 0; size < header.size(); ++size) {
      const Bytes prefix(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(size));
      try {
        const Header read = peek_header(prefix, "x");
        EXPECT_GT(read.width, 0);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::kInput);
        ++refused;
      }
    }
    EXPECT_GT(refused, 8);  // at least everything shorter than a signature and one number
  }
}

}  // namespace
}  // namespace faceprobe::io
