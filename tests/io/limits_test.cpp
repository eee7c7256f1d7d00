// Files that ask for more than is allowed, or are no files at all, are refused before anything is decoded.

#include "faceprobe/io/limits.h"

#include "faceprobe/io/photo.h"
#include "fixtures.h"

#include <sys/stat.h>
#include <unistd.h>
#include <chrono>

namespace faceprobe::io {
namespace {

using namespace testing;
namespace fs = std::filesystem;

// Refusals must cost nothing: a decoder at work on one of the bombs takes seconds to minutes, a header read microseconds.
constexpr double kAtOnceSeconds = 0.5;

void expect_refused(const fs::path& path, const std::vector<std::string>& parts, const Limits& limits = {}) {
  const auto start = std::chrono::steady_clock::now();
  expect_error(ExitCode::kInput, parts, [&] { load_photo(path, limits); });
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), kAtOnceSeconds);
}

Bytes jpeg_claiming(int marker, int side, int scans) {
  Bytes b;
  put_big(b, 0xFFD8, 2);
  put_big(b, static_cast<std::uint64_t>(marker), 2);
  put_big(b, 17, 2);
  put_big(b, 8, 1);
  put_big(b, static_cast<std::uint64_t>(side), 2);
  put_big(b, static_cast<std::uint64_t>(side), 2);
  put_big(b, 3, 1);
  put_big(b, 0x011100, 3);
  put_big(b, 0x021100, 3);
  put_big(b, 0x031100, 3);
  for (int i = 0; i < scans; ++i) {
    put_big(b, 0xFFDA, 2);
    put_big(b, 8, 2);
    put_big(b, 0x010100000000, 6);
  }
  put_big(b, 0xFFD9, 2);
  return b;
}

TEST(LimitsTest, DefaultsAreUsableAndNonsenseIsNot) {
  EXPECT_EQ(Limits{}.validate(), "");
  Limits limits;
  limits.max_pixels = 0;
  EXPECT_NE(limits.validate().find("pixels"), std::string::npos);
  TempFolder folder;
  expect_error(ExitCode::kUsage, {"pixels"}, [&] { load_photo(folder / "x.png", limits); });
}

TEST(LimitsTest, PngBomb) {
  TempFolder folder;
  const fs::path path = folder / "bomb.png";
  write_bytes("png", path, gradient(8, 8, 3));
  Bytes b = slurp(path);
  Bytes side;
  put_big(side, 46340, 4);
  std::copy(side.begin(), side.end(), b.begin() + 16);
  std::copy(side.begin(), side.end(), b.begin() + 20);
  spit(path, b);
  expect_refused(path,
                 {"bomb.png", "46340 x 46340 px", std::to_string(b.size()) + " bytes", "100000000", "--max-pixels"});
}

TEST(LimitsTest, JpegBombs) {
  TempFolder folder;
  const fs::path path = folder / "bomb.jpg";
  for (const int marker : {0xFFC0, 0xFFC2}) {
    spit(path, jpeg_claiming(marker, 65500, 1));
    expect_refused(path, {"65500 x 65500 px", "--max-pixels"});
    // Below the pixel limit, but far more than so few bytes can hold.
    spit(path, jpeg_claiming(marker, 9900, 1));
    expect_refused(path, {"9900 x 9900 px", "times"});
  }
  spit(path, jpeg_claiming(0xFFC2, 64, 101));
  expect_refused(path, {"101 JPEG scans", "100"});
}

TEST(LimitsTest, LimitsCanBeSet) {
  TempFolder folder;
  const fs::path path = folder / "x.png";
  write_bytes("png", path, gradient(40, 20, 3));
  Limits limits;
  limits.max_pixels = 800;
  EXPECT_EQ(load_photo(path, limits).linear.width(), 40);
  limits.max_pixels = 799;
  expect_refused(path, {"40 x 20", "799", "--max-pixels"}, limits);
  limits = {};
  limits.max_side_px = 39;
  expect_refused(path, {"40 x 20", "39 px on a side"}, limits);
  limits = {};
  limits.max_file_bytes = 50;
  expect_refused(path, {"at most 50", "--max-bytes"}, limits);
}

TEST(LimitsTest, NotAFile) {
  TempFolder folder;
  expect_refused(folder.path(), {"folder"});
  expect_refused(folder / "nothing.jpg", {"nothing.jpg", "No such file"});
  expect_refused("/dev/zero", {"/dev/zero", "device"});
  const fs::path pipe = folder / "pipe.jpg";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_refused(pipe, {"pipe"});  // without a writer: opening it would wait for ever
  spit(folder / "empty.jpg", {});
  expect_refused(folder / "empty.jpg", {"is empty"});
}

TEST(LimitsTest, NotAllowedToRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may read everything";
  TempFolder folder;
  const fs::path path = folder / "secret.png";
  write_bytes("png", path, gradient(4, 4, 3));
  fs::permissions(path, fs::perms::none);
  expect_refused(path, {"secret.png", "Permission denied"});
}

}  // namespace
}  // namespace faceprobe::io
