#include "paper/folder_listing.h"

#include "faceprobe/io/data_files.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <vector>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kWholeBelowBytes = 1 << 20;
constexpr std::uintmax_t kEndBytes = 64 << 10;

// Of `count` bytes from `offset`; empty where they cannot be read.
std::string bytes_at(std::ifstream& file, std::uintmax_t offset, std::uintmax_t count) {
  std::string bytes(count, '\0');
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  return file ? bytes : std::string();
}

std::string hash_of(const fs::path& path, std::uintmax_t size) {
  std::ifstream file(path, std::ios::binary);
  if (size < kWholeBelowBytes) return io::sha256_hex(bytes_at(file, 0, size));
  return io::sha256_hex(bytes_at(file, 0, kEndBytes) + bytes_at(file, size - kEndBytes, kEndBytes));
}

}  // namespace

std::string listing_of(const fs::path& folder) {
  std::vector<std::string> lines;
  std::error_code gone;
  for (fs::recursive_directory_iterator it(folder, fs::directory_options::follow_directory_symlink, gone), end;
       it != end; it.increment(gone)) {
    if (!it->is_regular_file(gone)) continue;
    const std::uintmax_t size = it->file_size(gone);
    if (gone) continue;
    lines.push_back(it->path().lexically_relative(folder).string() + ' ' + std::to_string(size) + ' ' +
                    hash_of(it->path(), size));
  }
  std::ranges::sort(lines);
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace faceprobe::cli
