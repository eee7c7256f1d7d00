// Damaged files: cut short at many places, and with bytes changed. Whatever happens inside the decoders, what leaves
// load_photo is a photo of the size its header says or an Error; run under sanitizers this is a small fuzzer's replay.

#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "fixtures.h"
#include "io/photo_bytes.h"

#include <cmath>
#include <random>

namespace faceprobe::io {
namespace {

using namespace testing;

struct Sample {
  std::string format;
  Bytes bytes;
};

std::vector<Sample> samples() {
  TempFolder folder;
  std::vector<Sample> all;
  const ByteImage image = gradient(40, 36, 3);
  OIIO::ParamValueList attributes;
  attributes.attribute("Orientation", 6);
  attributes.attribute("Exif:FocalLengthIn35mmFilm", 35);
  for (const char* format : {"jpeg", "png", "tiff", "webp"}) {
    write_bytes(format, folder / "x", image, attributes);
    all.push_back({format, slurp(folder / "x")});
  }
  attributes.attribute("jpeg:progressive", 1);
  write_bytes("jpeg", folder / "x", image, attributes);
  all.push_back({"jpeg", slurp(folder / "x")});
  const Image light(40, 36, 3, 0.3F);
  for (const char* name : {"x.exr", "x.hdr"}) {
    write_picture(folder / name, light);
    all.push_back({std::string(name).substr(2), slurp(folder / name)});
  }
  return all;
}

Limits small_limits() {  // so that a changed size field cannot make a test slow
  Limits limits;
  limits.max_pixels = 1'000'000;
  return limits;
}

// True when it loaded. Anything but a well-formed photo or an input error fails the test.
bool survives(const Bytes& bytes) {
  try {
    const Photo photo = photo_from_bytes(bytes, "x", small_limits());
    EXPECT_TRUE(photo.clipped.same_size(photo.linear));
    EXPECT_GT(photo.linear.width(), 0);
    for (const float value : photo.linear.values()) {
      if (!(value >= 0.0F && std::isfinite(value))) {
        ADD_FAILURE() << "a value that is not light: " << value;
        break;
      }
    }
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return false;
  }
}

TEST(Hostile, SamplesAreSound) {
  for (const Sample& sample : samples()) EXPECT_TRUE(survives(sample.bytes)) << sample.format;
}

TEST(Hostile, CutShort) {
  constexpr std::size_t kPlaces = 64;
  for (const Sample& sample : samples()) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const std::size_t size = sample.bytes.size() * i / kPlaces;
      const Bytes cut(sample.bytes.begin(), sample.bytes.begin() + static_cast<std::ptrdiff_t>(size));
      const bool loaded = survives(cut);
      // TIFF may keep its pixels in front of its directory's last bytes; the others must not pass as whole.
      EXPECT_FALSE(loaded && sample.format != "tiff")
          << sample.format << " cut to " << size << " of " << sample.bytes.size();
    }
  }
}

TEST(Hostile, ChangedBytes) {
  constexpr int kMutations = 300;
  for (const Sample& sample : samples()) {
    std::mt19937 random(20240607);  // the same damage in every run
    for (int i = 0; i < kMutations; ++i) {
      Bytes bad = sample.bytes;
      // Half of the changes in the first bytes, where the headers are.
      const std::size_t span = i % 2 == 0 ? std::min<std::size_t>(bad.size(), 200) : bad.size();
      const unsigned changes = 1 + random() % 4;
      for (unsigned k = 0; k < changes; ++k) {
        const std::size_t at = random() % span;
        bad[at] = i % 3 == 0 ? static_cast<std::byte>(0xFF) : bad[at] ^ static_cast<std::byte>(1U << (random() % 8));
      }
      survives(bad);
      if (::testing::Test::HasFailure()) {
        ADD_FAILURE() << sample.format << " mutation " << i;
        return;
      }
    }
  }
}

}  // namespace
}  // namespace faceprobe::io
