#include "faceprobe/io/atomic_file.h"

#include "fixtures.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <fstream>

namespace faceprobe::io {
namespace {

using namespace testing;
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  const Bytes bytes = slurp(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t entries(const TempFolder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

TEST(AtomicFile, WritesAndReplaces) {
  TempFolder folder;
  write_file_atomically(folder / "report.json", std::string_view("first, longer"));
  write_file_atomically(folder / "report.json", std::string_view("second"));
  EXPECT_EQ(text_of(folder / "report.json"), "second");
  EXPECT_EQ(entries(folder), 1U);
}

TEST(AtomicFile, CallbackSeesTheExtensionAndTheOldFile) {
  TempFolder folder;
  write_file_atomically(folder / "map.exr", std::string_view("old"));
  write_file_atomically(folder / "map.exr", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".exr");
    EXPECT_EQ(temporary.parent_path(), folder.path());
    std::ofstream(temporary) << "new";
    EXPECT_EQ(text_of(folder / "map.exr"), "old");
  });
  EXPECT_EQ(text_of(folder / "map.exr"), "new");
}

TEST(AtomicFile, ThrowingCallbackLeavesTheOldFileAndNothingElse) {
  TempFolder folder;
  write_file_atomically(folder / "map.exr", std::string_view("old"));
  EXPECT_THROW(write_file_atomically(folder / "map.exr",
                                     [](const fs::path& temporary) {
                                       std::ofstream(temporary) << "half of it";
                                       throw std::runtime_error("encoder failed");
                                     }),
               std::runtime_error);
  EXPECT_EQ(text_of(folder / "map.exr"), "old");
  EXPECT_EQ(entries(folder), 1U);
}

TEST(AtomicFile, FailuresNameTheTargetAndTheReason) {
  TempFolder folder;
  const auto write = [](const fs::path& path) { write_file_atomically(path, std::string_view("x")); };
  expect_error(ExitCode::kOutput, {"none/x.json", "No such file or directory"}, [&] { write(folder / "none/x.json"); });
  expect_error(ExitCode::kOutput, {"folder"}, [&] { write(folder.path()); });
  expect_error(ExitCode::kOutput, {"/dev/null", "not a regular file"}, [&] { write("/dev/null"); });
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));  // still the device
}

TEST(AtomicFile, ReadOnlyFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  TempFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  expect_error(ExitCode::kOutput, {"Permission denied"},
               [&] { write_file_atomically(folder / "x.json", std::string_view("x")); });
  fs::permissions(folder.path(), fs::perms::owner_all);
}

// A limit on the file size stands in for a full disk: write() fails part of the way.
TEST(AtomicFile, WriteThatFailsHalfwayLeavesTheOldFile) {
  TempFolder folder;
  write_file_atomically(folder / "x.bin", std::string_view("old"));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_error(ExitCode::kOutput, {"x.bin", "File too large"}, [&] {
    const std::string large(5000, 'x');
    write_file_atomically(folder / "x.bin", std::string_view(large));
  });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(text_of(folder / "x.bin"), "old");
  EXPECT_EQ(entries(folder), 1U);
}

TEST(AtomicFile, KeepsPermissionsAndFollowsLinks) {
  TempFolder folder;
  write_file_atomically(folder / "x.json", std::string_view("old"));
  fs::permissions(folder / "x.json", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink(folder / "x.json", folder / "link.json");
  write_file_atomically(folder / "link.json", std::string_view("new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link.json"));
  EXPECT_EQ(text_of(folder / "x.json"), "new");
  EXPECT_EQ(fs::status(folder / "x.json").permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST(AtomicFile, LongNames) {
  TempFolder folder;
  std::string name(250, 'n');  // the longest a file system takes is 255
  name += ".json";
  write_file_atomically(folder / name, std::string_view("x"));
  EXPECT_EQ(text_of(folder / name), "x");
}

TEST(AtomicFile, CreateFolder) {
  TempFolder folder;
  create_folder(folder / "a/b/c");
  create_folder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  write_file_atomically(folder / "file", std::string_view("x"));
  expect_error(ExitCode::kOutput, {"file"}, [&] { create_folder(folder / "file"); });
  expect_error(ExitCode::kOutput, {"file/below"}, [&] { create_folder(folder / "file/below"); });
}

}  // namespace
}  // namespace faceprobe::io
