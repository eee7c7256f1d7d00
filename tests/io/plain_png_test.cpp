#include "io/plain_png.h"

#include "fixtures.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <fstream>
#include <stdexcept>

namespace faceprobe::io {
namespace {

using namespace testing;

// Another reader finds the bytes that were written. It checks the sums, and so would notice a wrong one.
TEST(PlainPng, OpenImageIoReadsItBack) {
  const TempFolder folder;
  // The last is longer than one stored block, 65,535 bytes; its rows end within blocks.
  const std::array<std::array<int, 3>, 4> sizes = {{{1, 1, 1}, {7, 5, 3}, {6, 9, 4}, {211, 150, 3}}};
  for (const auto& [width, height, channels] : sizes) {
    ByteImage picture(width, height, channels);
    for (std::size_t i = 0; i < picture.values().size(); ++i)
      picture.data()[i] = static_cast<std::uint8_t>(i * 37 % 251);
    const std::vector<std::byte> bytes = plain_png(picture);
    const std::string path = (folder / "picture.png").string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    OIIO::ImageSpec as_written;
    as_written.attribute("oiio:UnassociatedAlpha", 1);
    const std::unique_ptr<OIIO::ImageInput> file = OIIO::ImageInput::open(path, &as_written);
    ASSERT_TRUE(file) << OIIO::geterror();
    EXPECT_EQ(file->spec().width, width);
    EXPECT_EQ(file->spec().height, height);
    ASSERT_EQ(file->spec().nchannels, channels);
    ByteImage read(width, height, channels);
    ASSERT_TRUE(file->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, read.data())) << file->geterror();
    EXPECT_EQ(read, picture);
  }
}

TEST(PlainPng, OtherPicturesAreRefused) {
  EXPECT_THROW(plain_png(ByteImage(2, 2, 2)), std::invalid_argument);
  EXPECT_THROW(plain_png(ByteImage()), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::io
