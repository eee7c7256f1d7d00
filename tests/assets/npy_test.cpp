#include "assets/npy.h"

#include "file_fixtures.h"

#include <cstring>

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::npy_text;
using testing::TempFolder;

Array parse(const std::string& text) { return parse_npy(std::as_bytes(std::span(text)), "the array"); }

TEST(Npy, ReadsEveryTypeAllowed) {
  EXPECT_EQ(parse(npy_text<std::uint16_t>("<f2", {2}, {0x3C00, 0xC100})).values,
            (std::vector<float>{1.0F, -2.5F}));  // IEEE halves
  EXPECT_EQ(parse(npy_text<float>("<f4", {2}, {1.5F, -2})).values, (std::vector<float>{1.5F, -2}));
  EXPECT_EQ(parse(npy_text<double>("<f8", {2}, {1.5, -2})).values, (std::vector<float>{1.5F, -2}));
  EXPECT_EQ(parse(npy_text<std::uint8_t>("|u1", {2}, {7, 255})).values, (std::vector<float>{7, 255}));
  EXPECT_EQ(parse(npy_text<std::int32_t>("<i4", {2}, {-1, 26718})).values, (std::vector<float>{-1, 26718}));
  EXPECT_EQ(parse(npy_text<std::int64_t>("<i8", {2}, {-1, 26718})).values, (std::vector<float>{-1, 26718}));
  EXPECT_TRUE(parse(npy_text<std::int64_t>("<i8", {1}, {0})).is_integer);
  EXPECT_FALSE(parse(npy_text<float>("<f4", {1}, {0})).is_integer);
}

TEST(Npy, ReadsShapesAndBothVersions) {
  const std::vector<float> values = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(parse(npy_text("<f4", {1, 2, 3}, values)).shape, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(parse(npy_text("<f4", {2, 3}, std::as_bytes(std::span(values)), 2)).values, values);
  EXPECT_TRUE(parse(npy_text<float>("<f4", {0, 3}, {})).values.empty());
  EXPECT_EQ(parse(npy_text<float>("<f4", {}, {4})).values, (std::vector<float>{4}));  // a single number
}

TEST(Npy, RefusesWhatItCannotRead) {
  const auto refused = [](const std::string& text, const std::vector<std::string>& words) {
    expect_error(ExitCode::kInput, words, [&] { parse(text); });
  };
  const std::string good = npy_text<float>("<f4", {2, 3}, {0, 1, 2, 3, 4, 5});
  refused("PK\3\4 something else", {"the array", "not a NumPy array"});
  refused("", {"not a NumPy array"});
  refused(good.substr(0, good.size() - 1), {"24 bytes", "2 x 3", "holds 23", "cut off"});
  refused(good + "x", {"holds 25"});
  refused(good.substr(0, 30), {"ends within its header"});
  refused(npy_text<float>(">f4", {1}, {0}), {"'>f4'", "little-endian f2, f4"});
  refused(npy_text<double>("<c8", {1}, {0}), {"'<c8'"});
  refused(npy_text<float>("|O", {1}, {0}), {"'|O'"});
  const std::vector<float> six(6);
  refused(npy_text("<f4", {2, 3}, std::as_bytes(std::span(six)), 1, true), {"by columns", "ascontiguousarray"});
  refused(npy_text("<f4", {2, 3}, std::as_bytes(std::span(six)), 3), {"version 3"});
  refused(npy_text<std::int64_t>("<i8", {1}, {1LL << 40}), {"1099511627776", "too large"});
  refused(npy_text<float>("<f4", {1ULL << 40, 1ULL << 40}, {0}), {"larger than 1 GiB"});
  std::string no_shape = good;
  no_shape.replace(no_shape.find("shape"), 5, "shabe");
  refused(no_shape, {"no 'shape'"});
}

TEST(Npz, ReadsArraysByName) {
  const TempFolder folder;
  testing::write_npz(folder / "a.npz",
                     {{"one", npy_text<float>("<f4", {1}, {1})}, {"two", npy_text<std::int32_t>("<i4", {2}, {2, 3})}});
  const Arrays arrays = read_npz(folder / "a.npz");
  ASSERT_EQ(arrays.size(), 2U);
  EXPECT_EQ(arrays.at("two").values, (std::vector<float>{2, 3}));
}

TEST(Npz, RefusesDamage) {
  const TempFolder folder;
  testing::write_text(folder / "text.npz", "this is no archive");
  expect_error(ExitCode::kInput, {"text.npz", "archive"}, [&] { read_npz(folder / "text.npz"); });
  expect_error(ExitCode::kInput, {"none.npz"}, [&] { read_npz(folder / "none.npz"); });
  const std::string cut = npy_text<float>("<f4", {4}, {1, 2, 3, 4});
  testing::write_npz(folder / "cut.npz", {{"bad", cut.substr(0, cut.size() - 3)}});
  expect_error(ExitCode::kInput, {"cut.npz", "'bad'", "cut off"}, [&] { read_npz(folder / "cut.npz"); });
}

}  // namespace
}  // namespace faceprobe::assets
