#include "serve/archive.h"

#include "faceprobe/core/error.h"

#include <zip.h>
#include <memory>

namespace faceprobe::serve {
namespace {

[[noreturn]] void give_up(zip_error_t* error) {
  throw Error(ExitCode::kOutput, "The archive could not be made: " + std::string(zip_error_strerror(error)) + ".");
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct Free {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};

}  // namespace

std::string zip_of(const std::filesystem::path& folder, const std::vector<ServedFile>& files, const std::string& top) {
  zip_error_t error;
  zip_error_init(&error);
  const std::unique_ptr<zip_source_t, Free> bytes(zip_source_buffer_create(nullptr, 0, 0, &error));
  if (!bytes) give_up(&error);
  zip_source_keep(bytes.get());  // closing the archive gives one hold of it back
  std::unique_ptr<zip_t, Discard> archive(zip_open_from_source(bytes.get(), ZIP_TRUNCATE, &error));
  if (!archive) give_up(&error);
  for (const ServedFile& file : files) {
    zip_source_t* source = zip_source_file(archive.get(), (folder / file.path).c_str(), 0, -1);
    const zip_int64_t added = source == nullptr ? -1
                                                : zip_file_add(archive.get(), (top + "/" + file.path).c_str(), source,
                                                               ZIP_FL_ENC_UTF_8 | ZIP_FL_OVERWRITE);
    if (added < 0) {
      zip_source_free(source);
      give_up(zip_get_error(archive.get()));
    }
    // EXR and PNG are packed already.
    zip_set_file_compression(archive.get(), static_cast<zip_uint64_t>(added), ZIP_CM_STORE, 0);
  }
  if (zip_close(archive.get()) != 0) give_up(zip_get_error(archive.get()));
  static_cast<void>(archive.release());
  if (zip_source_open(bytes.get()) != 0) give_up(zip_source_error(bytes.get()));
  zip_stat_t stat;
  zip_stat_init(&stat);
  zip_source_stat(bytes.get(), &stat);
  std::string out(stat.size, '\0');
  const zip_int64_t read = zip_source_read(bytes.get(), out.data(), out.size());
  zip_source_close(bytes.get());
  if (read != static_cast<zip_int64_t>(out.size())) give_up(zip_source_error(bytes.get()));
  return out;
}

}  // namespace faceprobe::serve
