#include "faceprobe/io/safetensors.h"

#include "faceprobe/io/data_files.h"
#include "fixtures.h"

#include <cstring>

namespace faceprobe::io {
namespace {

using namespace testing;

Bytes file_of(const std::string& header, const Bytes& data) {
  Bytes b;
  put_little(b, header.size(), 8);
  put_text(b, header);
  b.insert(b.end(), data.begin(), data.end());
  return b;
}

Bytes floats(const std::vector<float>& values) {
  Bytes b(values.size() * sizeof(float));
  std::memcpy(b.data(), values.data(), b.size());
  return b;
}

class Safetensors : public ::testing::Test {
 protected:
  TensorFile read(const Bytes& bytes) {
    spit(folder_ / "w.safetensors", bytes);
    return read_safetensors(folder_ / "w.safetensors");
  }
  void expect_refused(const Bytes& bytes, const std::string& part) {
    expect_error(ExitCode::kModel, {"w.safetensors", part}, [&] { read(bytes); });
  }
  TempFolder folder_;
};

TEST_F(Safetensors, ReadsTheThreeKindsAndMetadata) {
  const std::string header =
      R"({"__metadata__":{"arch":"unet-3"},"a":{"dtype":"F32","shape":[2,1],"data_offsets":[0,8]},)"
      R"("h":{"dtype":"F16","shape":[5],"data_offsets":[8,18]},"b":{"dtype":"BF16","shape":[],"data_offsets":[18,20]},)"
      R"("none":{"dtype":"F32","shape":[0,4],"data_offsets":[20,20]}})";
  Bytes data = floats({1.5F, -0.1F});
  for (const int half : {0x3C00, 0xC000, 0x0001, 0x7BFF, 0x8000}) put_little(data, static_cast<std::uint64_t>(half), 2);
  put_little(data, 0x4049, 2);
  const Bytes bytes = file_of(header, data);
  const TensorFile file = read(bytes);
  EXPECT_EQ(file.metadata.at("arch"), "unet-3");
  EXPECT_EQ(file.sha256, sha256_hex(bytes.data(), bytes.size()));
  EXPECT_EQ(file.tensor("a", {2, 1}).values, (std::vector<float>{1.5F, -0.1F}));
  EXPECT_EQ(file.tensor("h", {5}).values, (std::vector<float>{1.0F, -2.0F, 0x1p-24F, 65504.0F, -0.0F}));
  EXPECT_EQ(file.tensor("b", {}).values, (std::vector<float>{3.140625F}));
  EXPECT_TRUE(file.tensor("none", {0, 4}).values.empty());
}

TEST_F(Safetensors, MissingOrMisshapenTensorIsNamed) {
  const TensorFile file = read(file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})", floats({1, 2})));
  expect_error(ExitCode::kModel, {"'b'", "[3]"}, [&] { file.tensor("b", {3}); });
  expect_error(ExitCode::kModel, {"'a'", "[2]", "[1, 2]"}, [&] { file.tensor("a", {1, 2}); });
}

TEST_F(Safetensors, HeaderAttacks) {
  Bytes huge;
  put_little(huge, 1ULL << 63, 8);
  expect_refused(huge, "9223372036854775808");
  Bytes four_gb;
  put_little(four_gb, 4ULL << 30, 8);
  put_text(four_gb, "{}");
  expect_refused(four_gb, "at most 1048576");
  Bytes cut;
  put_little(cut, 100, 8);
  put_text(cut, "{");
  expect_refused(cut, "cut short");
  expect_refused(to_bytes("abc"), "3 bytes");
  expect_refused({}, "0 bytes");
  expect_refused(file_of("not json", {}), "JSON");
  expect_refused(file_of("[1,2]", {}), "no JSON object");
  expect_refused(file_of(R"({"a":)" + std::string(100'000, '['), {}), "nested");
  expect_refused(file_of(R"({"__metadata__":{"a":1}})", {}), "no text");
}

TEST_F(Safetensors, DuplicateKeys) {
  expect_refused(file_of(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":[0,4]},)"
                         R"("a":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})",
                         floats({1, 2})),
                 "'a' twice");
  expect_refused(file_of(R"({"a":{"dtype":"F32","shape":[1],"shape":[2],"data_offsets":[0,4]}})", floats({1})),
                 "twice");
}

TEST_F(Safetensors, OffsetsMustCoverTheDataExactly) {
  const auto two = [](const char* first, const char* second) {
    return file_of(std::string(R"({"a":{"dtype":"F32","shape":[1],"data_offsets":)") + first +
                       R"(},"b":{"dtype":"F32","shape":[1],"data_offsets":)" + second + "}}",
                   floats({1, 2, 3}));
  };
  expect_refused(two("[0,4]", "[2,6]"), "overlapping");
  expect_refused(two("[0,4]", "[0,4]"), "overlapping");
  expect_refused(two("[0,4]", "[8,12]"), "hole");
  expect_refused(two("[4,8]", "[8,12]"), "hole");
  expect_refused(two("[0,4]", "[4,8]"), "belong to no tensor");
  expect_refused(two("[0,4]", "[12,16]"), "outside the file");
  expect_refused(two("[4,0]", "[4,8]"), "outside the file");
  expect_refused(two("[-1,3]", "[4,8]"), "whole number");
  expect_refused(two("[0.5,4]", "[4,8]"), "whole number");
  expect_refused(two("[0,18446744073709551615]", "[4,8]"), "outside the file");
  expect_refused(two("[0]", "[4,8]"), "pair of offsets");
}

TEST_F(Safetensors, ShapesAndKinds) {
  const auto one = [](const std::string& shape, const std::string& dtype = "F32") {
    return file_of(R"({"a":{"dtype":")" + dtype + R"(","shape":)" + shape + R"(,"data_offsets":[0,8]}})",
                   floats({1, 2}));
  };
  EXPECT_NO_THROW(read(one("[2]")));
  expect_refused(one("[3]"), "do not fit");
  expect_refused(one("[4294967296,4294967296,2]"), "too large");
  expect_refused(one("[1099511627776,16777216,2]"), "too large");  // the product is 2^65
  expect_refused(one("[-2]"), "whole number");
  expect_refused(one("[1,1,1,1,1,1,1,1,2]"), "at most 8");
  expect_refused(one("2"), "shape");
  expect_refused(one("[1]", "F64"), "F64");
  expect_refused(one("[2]", "I32"), "I32");
  expect_refused(file_of(R"({"a":7})", {}), "no object");
}

TEST_F(Safetensors, ValuesMustBeNumbers) {
  const std::string header = R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})";
  expect_refused(file_of(header, floats({1, std::numeric_limits<float>::quiet_NaN()})), "NaN");
  expect_refused(file_of(header, floats({-std::numeric_limits<float>::infinity(), 0})), "infinity");
  Bytes half;
  put_little(half, 0x7C00, 2);
  expect_refused(file_of(R"({"a":{"dtype":"F16","shape":[1],"data_offsets":[0,2]}})", half), "infinity");
}

TEST_F(Safetensors, TooManyTensors) {
  std::string header = "{";
  for (int i = 0; i < 5000; ++i) {
    header += (i > 0 ? ",\"t" : "\"t") + std::to_string(i) + R"(":{"dtype":"F32","shape":[0],"data_offsets":[0,0]})";
  }
  expect_refused(file_of(header + "}", {}), "5000 tensors");
}

TEST_F(Safetensors, UnreadableFilesAreModelErrors) {
  expect_error(ExitCode::kModel, {"No such file"}, [&] { read_safetensors(folder_ / "absent.safetensors"); });
  expect_error(ExitCode::kModel, {"device"}, [] { read_safetensors("/dev/zero"); });
}

// Every single-byte change of a file is refused, or loads with another checksum: none passes unseen.
TEST_F(Safetensors, NoMutationPassesUnseen) {
  const Bytes good = file_of(R"({"a":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})", floats({1, 2}));
  const std::string checksum = read(good).sha256;
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= static_cast<std::byte>(1U << (i % 8));
    try {
      EXPECT_NE(read(bad).sha256, checksum);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kModel);
    }
  }
}

}  // namespace
}  // namespace faceprobe::io
