#include "faceprobe/io/data_files.h"

#include "faceprobe/io/atomic_file.h"
#include "fixtures.h"

#include <cstdlib>

namespace faceprobe::io {
namespace {

using namespace testing;

std::string digest(std::string_view text) {
  const Bytes bytes = to_bytes(text);
  return sha256_hex(bytes.data(), bytes.size());
}

// FIPS 180-4 examples, and lengths on both sides of the padding's block limits.
TEST(Sha256, KnownAnswers) {
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(digest(std::string(55, 'a')), "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  EXPECT_EQ(digest(std::string(64, 'a')), "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}

class DataFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* old = std::getenv("FACEPROBE_DATA_DIR")) old_ = old;
  }
  void TearDown() override {
    if (old_.empty()) {
      ::unsetenv("FACEPROBE_DATA_DIR");
    } else {
      ::setenv("FACEPROBE_DATA_DIR", old_.c_str(), 1);
    }
  }
  std::string old_;
};

TEST_F(DataFolder, NamedFolderIsTheOnlyOne) {
  TempFolder folder;
  write_file_atomically(folder / "model.bin", std::string_view("x"));
  ::setenv("FACEPROBE_DATA_DIR", folder.path().c_str(), 1);
  EXPECT_EQ(data_folders().size(), 1U);
  EXPECT_EQ(data_file("model.bin"), folder / "model.bin");
  expect_error(ExitCode::kModel, {"other.bin", folder.path().string(), "scripts/setup.sh"},
               [] { data_file("other.bin"); });
}

TEST_F(DataFolder, OtherwiseBesideTheProgramThenTheBuild) {
  ::unsetenv("FACEPROBE_DATA_DIR");
  const auto folders = data_folders();
  ASSERT_EQ(folders.size(), 3U);
  EXPECT_TRUE(folders[0].string().ends_with("share/faceprobe"));
  expect_error(ExitCode::kModel, {"no_such_model.bin", folders[0].string(), folders[1].string()},
               [] { data_file("no_such_model.bin"); });
}

TEST(ReadFile, WholeOrRefused) {
  TempFolder folder;
  const std::string text(10'000, 'z');
  write_file_atomically(folder / "x", std::string_view(text));
  EXPECT_EQ(read_file(folder / "x", 10'000), to_bytes(text));
  expect_error(ExitCode::kInput, {"10000 bytes", "9999"}, [&] { read_file(folder / "x", 9'999); });
  expect_error(ExitCode::kInput, {"No such file"}, [&] { read_file(folder / "y", 10); });
  expect_error(ExitCode::kInput, {"folder"}, [&] { read_file(folder.path(), 10); });
}

}  // namespace
}  // namespace faceprobe::io
