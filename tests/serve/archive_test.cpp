#include "serve/archive.h"

#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <fstream>
#include <map>
#include <memory>

namespace faceprobe::serve {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;
using Contents = std::map<std::string, std::string>;

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

// What libzip finds in an archive, every checksum tested.
Contents unpacked(const std::string& bytes) {
  Contents contents;
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open_from_source(source, ZIP_CHECKCONS, &error),
                                                               zip_discard);
  EXPECT_NE(archive, nullptr) << zip_error_strerror(&error);
  if (!archive) return contents;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    zip_stat_t stat;
    EXPECT_EQ(zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &stat), 0);
    std::string file(stat.size, '\0');
    zip_file_t* const open = zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(i), 0);
    EXPECT_EQ(zip_fread(open, file.data(), file.size()), static_cast<zip_int64_t>(file.size()));
    EXPECT_EQ(zip_fclose(open), 0);
    contents[stat.name] = file;
  }
  return contents;
}

TEST(Archive, HasTheSameNamesAndBytes) {
  const TempFolder folder;
  std::string noise;
  for (unsigned i = 0; i < 100'000; ++i) noise += static_cast<char>((i * i) >> 5U);
  write_bytes(folder / "report.json", "{}");
  write_bytes(folder / "face_1/map.exr", noise);
  write_bytes(folder / "face_2/map.exr", noise + "other");
  write_bytes(folder / "empty.txt", "");
  write_bytes(folder / "Grüße.txt", "umlauts");
  const std::string bytes = zip_of(folder.path(), files_of(folder.path()), "faceprobe");
  EXPECT_EQ(unpacked(bytes), (Contents{{"faceprobe/report.json", "{}"},
                                       {"faceprobe/face_1/map.exr", noise},
                                       {"faceprobe/face_2/map.exr", noise + "other"},
                                       {"faceprobe/empty.txt", ""},
                                       {"faceprobe/Grüße.txt", "umlauts"}}));
}

TEST(Archive, HoldsWhatIsListedAndNothingElse) {
  const TempFolder folder;
  write_bytes(folder / "one", "1");
  write_bytes(folder / "two", "2");
  EXPECT_EQ(unpacked(zip_of(folder.path(), {{"two", 1}}, "top")), (Contents{{"top/two", "2"}}));
}

TEST(Archive, AFileThatIsGoneIsASentence) {
  const TempFolder folder;
  write_bytes(folder / "one", "1");
  expect_error(ExitCode::kOutput, {"archive"}, [&] { zip_of(folder.path(), {{"one", 1}, {"gone", 1}}, "top"); });
}

}  // namespace
}  // namespace faceprobe::serve
