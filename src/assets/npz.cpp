#include "assets/npy.h"

#include <zip.h>
#include <memory>

namespace faceprobe::assets {
namespace {

constexpr zip_uint64_t kMaxEntryBytes = 1ULL << 30;
constexpr zip_int64_t kMaxEntries = 1000;

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

std::string reason(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

std::vector<std::byte> read_entry(zip_t* archive, zip_uint64_t index, zip_uint64_t size, const std::string& name) {
  const std::unique_ptr<zip_file_t, CloseEntry> entry(zip_fopen_index(archive, index, 0));
  if (!entry) refuse_input(name + " cannot be unpacked: " + zip_strerror(archive) + ".");
  std::vector<std::byte> bytes(size);
  if (zip_fread(entry.get(), bytes.data(), size) != static_cast<zip_int64_t>(size)) {
    refuse_input(name + " cannot be unpacked: " + zip_file_strerror(entry.get()) + ".");
  }
  // One byte more: the checksum is looked at when the end is read.
  std::byte beyond{};
  if (zip_fread(entry.get(), &beyond, 1) != 0)
    refuse_input(name + " is damaged: " + zip_file_strerror(entry.get()) + ".");
  return bytes;
}

}  // namespace

Arrays read_npz(const std::filesystem::path& path) {
  const std::string file = quoted(path);
  int code = 0;
  const std::unique_ptr<zip_t, CloseArchive> archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) refuse_input(file + " cannot be read as an .npz archive: " + reason(code) + ".");
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > kMaxEntries) refuse_input(file + " holds " + std::to_string(count) + " arrays; at most 1000 are read.");
  Arrays arrays;
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t status;
    if (zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &status) != 0) {
      refuse_input(file + " has a damaged directory: " + zip_strerror(archive.get()) + ".");
    }
    std::string name = status.name;
    if (!name.ends_with(".npy")) continue;
    name.resize(name.size() - 4);
    std::string what = file;
    what.append(": '").append(name).append("'");
    if (status.size > kMaxEntryBytes) refuse_input(what + " is larger than 1 GiB.");
    arrays.emplace(name, parse_npy(read_entry(archive.get(), static_cast<zip_uint64_t>(i), status.size, what), what));
  }
  return arrays;
}

}  // namespace faceprobe::assets
