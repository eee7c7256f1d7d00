#include "faceprobe/synth/sensor.h"

#include "faceprobe/core/random.h"

#include <gtest/gtest.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

// Smooth shading, an edge and texture, in colour: what every part of the coder has work with.
ByteImage test_picture(int width, int height, bool smooth = false) {
  ByteImage picture(width, height, 3);
  Random random({3});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double edge = !smooth && x + y > width ? 40 : 0;
      const double texture = !smooth && y > height / 2 ? random.normal(0, 10) : 0;
      const double base[3] = {150 + 60 * std::sin(x * 0.07), 110 + 50 * std::cos(y * 0.05 + 1),
                              90 + 45 * std::sin((x + y) * 0.04)};
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = static_cast<std::uint8_t>(std::clamp(base[c] + edge * (c - 1) + texture, 0.0, 255.0));
      }
    }
  }
  return picture;
}

double mean_difference(const ByteImage& a, const ByteImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) sum += std::abs(a.values()[i] - b.values()[i]);
  return sum / static_cast<double>(a.values().size());
}

int largest_difference(const ByteImage& a, const ByteImage& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    largest = std::max(largest, std::abs(a.values()[i] - b.values()[i]));
  return largest;
}

// Through a real file's bytes, by libjpeg.
ByteImage through_libjpeg(const ByteImage& picture, int quality, bool chroma_half) {
  OIIO::ImageSpec spec(picture.width(), picture.height(), picture.channels(), OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  spec.attribute("jpeg:subsampling", chroma_half ? "4:2:0" : "4:4:4");
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput out(bytes);
  const std::unique_ptr<OIIO::ImageOutput> writer = OIIO::ImageOutput::create("jpeg");
  if (!writer || !writer->set_ioproxy(&out) || !writer->open("x.jpg", spec) ||
      !writer->write_image(OIIO::TypeDesc::UINT8, picture.data()) || !writer->close()) {
    throw std::runtime_error(OIIO::geterror());
  }
  OIIO::Filesystem::IOMemReader in(bytes.data(), bytes.size());
  const std::unique_ptr<OIIO::ImageInput> reader = OIIO::ImageInput::open("x.jpg", nullptr, &in);
  ByteImage decoded(picture.width(), picture.height(), picture.channels());
  if (!reader || !reader->read_image(0, 0, 0, picture.channels(), OIIO::TypeDesc::UINT8, decoded.data())) {
    throw std::runtime_error(OIIO::geterror());
  }
  return decoded;
}

TEST(Jpeg, AgreesWithLibjpeg) {
  for (const auto& [width, height] : {std::pair{96, 80}, std::pair{61, 75}}) {
    const ByteImage picture = test_picture(width, height);
    for (const int quality : {20, 50, 75, 90, 95, 100}) {
      for (const bool half : {false, true}) {
        const ByteImage ours = jpeg_round_trip(picture, quality, half);
        const ByteImage theirs = through_libjpeg(picture, quality, half);
        // Theirs computes in whole numbers of 13 bits, so its coefficients are off by about a tenth: with steps of q one in 5 q
        // is rounded the other way, which moves the pixels of its block by q / 8. Of 64 coefficients that is 64 / (5 q) times
        // q / 8, as errors add: under 1.6, and less as most signs differ. A wrong table or filter would cost more than one code.
        EXPECT_LT(mean_difference(ours, theirs), 0.7) << quality << ' ' << half << ' ' << width;
        const double loss = mean_difference(picture, theirs);
        EXPECT_GT(quality < 100 ? loss : 1.0, 3 * mean_difference(ours, theirs)) << quality;
      }
    }
  }
}

TEST(Jpeg, AgreesWithLibjpegOnGrey) {
  ByteImage grey(64, 64, 1);
  const ByteImage picture = test_picture(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) grey(x, y) = picture(x, y, 1);
  }
  EXPECT_LT(mean_difference(jpeg_round_trip(grey, 70, true), through_libjpeg(grey, 70, true)), 0.7);  // as above
}

TEST(Jpeg, FullQualityChangesLittle) {
  const ByteImage picture = test_picture(64, 64);
  const ByteImage back = jpeg_round_trip(picture, 100, false);
  // All steps are 1: rounding to whole YCbCr and whole coefficients and back, each with an error of .3 at most on average.
  EXPECT_LT(mean_difference(picture, back), 1.0);
  EXPECT_LE(largest_difference(picture, back), 4);
  // At half size chroma loses what is finer than two pixels; a smooth picture has nothing there.
  const ByteImage smooth = test_picture(64, 64, true);
  EXPECT_LT(mean_difference(smooth, jpeg_round_trip(smooth, 100, true)), 1.0);
}

TEST(Jpeg, FlatBlocksStayAtFullQuality) {
  ByteImage flat(24, 17, 3);
  for (std::size_t i = 0; i < flat.pixel_count(); ++i) {
    flat.data()[3 * i] = 200;
    flat.data()[3 * i + 1] = 120;
    flat.data()[3 * i + 2] = 40;
  }
  // Only the rounding to whole Y, Cb, Cr is left, which weighs 1.402 and 1.772 on the way back.
  EXPECT_LE(largest_difference(flat, jpeg_round_trip(flat, 100, true)), 1);
  const ByteImage coarse = jpeg_round_trip(flat, 30, true);
  EXPECT_LE(largest_difference(coarse, jpeg_round_trip(coarse, 30, true)), 1);  // it is on the steps already
}

TEST(Jpeg, LowerQualityIsALargerError) {
  const ByteImage picture = test_picture(96, 96);
  double last = 0;
  for (const int quality : {100, 95, 85, 70, 50, 30, 10, 1}) {
    const double error = mean_difference(picture, jpeg_round_trip(picture, quality, true));
    EXPECT_GT(error, last) << quality;
    last = error;
  }
}

TEST(Jpeg, GreyStaysGrey) {
  ByteImage grey(33, 33, 3);
  for (std::size_t i = 0; i < grey.values().size(); ++i)
    grey.values()[i] = static_cast<std::uint8_t>((i / 3 * 7) % 256);
  const ByteImage back = jpeg_round_trip(grey, 40, true);
  for (std::size_t i = 0; i < back.pixel_count(); ++i) {
    EXPECT_EQ(back.data()[3 * i], back.data()[3 * i + 1]);
    EXPECT_EQ(back.data()[3 * i], back.data()[3 * i + 2]);
  }
}

TEST(Jpeg, RefusesWhatItCannotDo) {
  EXPECT_THROW(jpeg_round_trip(ByteImage(8, 8, 4), 90, true), std::invalid_argument);
  EXPECT_THROW(jpeg_round_trip(ByteImage(8, 8, 3), 0, true), std::invalid_argument);
  EXPECT_THROW(jpeg_round_trip(ByteImage(8, 8, 3), 101, true), std::invalid_argument);
  EXPECT_TRUE(jpeg_round_trip(ByteImage(0, 0, 3), 90, true).empty());
}

}  // namespace
}  // namespace faceprobe::synth
