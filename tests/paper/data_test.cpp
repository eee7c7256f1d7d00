// What the report is made from: data that are known by their contents, maps by their scenes.
#include "paper/folder_listing.h"
#include "scene_table.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>

namespace faceprobe::cli::testing {
namespace {

namespace fs = std::filesystem;
using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

void write_bytes(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

constexpr std::size_t kLargeBytes = 3 << 20;

void write_data(const fs::path& folder) {
  write_bytes(folder / "b" / "small.txt", "one photo");
  write_bytes(folder / "a.bin", std::string(kLargeBytes, 'x'));
  write_bytes(folder / "empty", "");
}

TEST(FolderListing, ACopyIsTheSameWhereverAndWheneverItWasMade) {
  const TempFolder folder;
  write_data(folder / "data");
  const std::string before = listing_of(folder / "data");
  EXPECT_EQ(std::ranges::count(before, '\n'), 3);
  fs::copy(folder / "data", folder / "elsewhere", fs::copy_options::recursive);
  fs::last_write_time(folder / "elsewhere" / "a.bin", fs::file_time_type::clock::now() - std::chrono::hours(50));
  EXPECT_EQ(listing_of(folder / "elsewhere"), before);
  fs::create_directory_symlink(folder / "data", folder / "link");
  EXPECT_EQ(listing_of(folder / "link"), before);
  EXPECT_EQ(listing_of(folder / "nowhere"), "");
}

TEST(FolderListing, AnotherByteNameOrFileIsSeen) {
  const TempFolder folder;
  write_data(folder / "data");
  const std::string before = listing_of(folder / "data");
  // Of the same size, and as old as before.
  const auto changes = [&](const fs::path& file, std::streamoff at) {
    const auto time = fs::last_write_time(file);
    std::fstream(file, std::ios::binary | std::ios::in | std::ios::out).seekp(at).put('!');
    fs::last_write_time(file, time);
    const bool seen = listing_of(folder / "data") != before;
    write_data(folder / "data");
    return seen;
  };
  EXPECT_TRUE(changes(folder / "data" / "b" / "small.txt", 4));
  EXPECT_TRUE(changes(folder / "data" / "a.bin", 10));
  EXPECT_TRUE(changes(folder / "data" / "a.bin", kLargeBytes - 10));
  EXPECT_EQ(listing_of(folder / "data"), before);
  fs::rename(folder / "data" / "a.bin", folder / "data" / "c.bin");
  EXPECT_NE(listing_of(folder / "data"), before);
  fs::rename(folder / "data" / "c.bin", folder / "data" / "a.bin");
  write_bytes(folder / "data" / "more", "");
  EXPECT_NE(listing_of(folder / "data"), before);
}

using Numbers = std::vector<std::size_t>;

TEST(MapsOfKind, AreThoseThatATableSays) {
  const TempFolder folder;
  const std::string first = folder / "first.csv";
  const std::string second = folder / "second.csv";
  write_bytes(first, "name,folder,scene\nhall,indoor,indoor\nmeadow,outdoor,sunny\nstreet,outdoor,night\n");
  write_bytes(second, "scene,name,folder\nindoor,\"a, b\",indoor\novercast,field,outdoor\n");
  const std::vector<std::string> maps = {"street", "hall", "field", "unknown", "a, b", "meadow"};
  EXPECT_EQ(maps_of_kind(maps, {first}, SceneKind::kIndoor), (Numbers{1}));
  EXPECT_EQ(maps_of_kind(maps, {first, second}, SceneKind::kIndoor), (Numbers{1, 4}));
  EXPECT_EQ(maps_of_kind(maps, {first, second}, SceneKind::kOutdoorByDay), (Numbers{2, 5}));
  EXPECT_EQ(maps_of_kind(maps, {}, SceneKind::kIndoor), Numbers{});
  write_bytes(second, "name,folder\nhall,indoor\n");
  expect_error(ExitCode::kInput, {"second.csv", "scene"}, [&] { maps_of_kind(maps, {second}, SceneKind::kIndoor); });
  expect_error(ExitCode::kInput, {"gone.csv"}, [&] { maps_of_kind(maps, {folder / "gone.csv"}, SceneKind::kIndoor); });
}

}  // namespace
}  // namespace faceprobe::cli::testing
