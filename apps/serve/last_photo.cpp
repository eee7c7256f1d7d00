#include "serve/last_photo.h"

#include "faceprobe/core/error.h"

#include <string>

namespace faceprobe::serve {
namespace {

// Of a file whose name is ours: the person at the page knows the photo by another, and our folders are nobody's business.
io::Photo loaded(const EstimateRecord& record, const io::Limits& limits) {
  const std::string file = record.photo_file().string();
  try {
    return io::load_photo(file, limits);
  } catch (const Error& error) {
    std::string sentence = error.what();
    if (const std::size_t at = sentence.find(file); at != std::string::npos)
      sentence.replace(at, file.size(), "'" + record.name + "'");
    throw Error(error.code(), sentence);
  }
}

}  // namespace

std::shared_ptr<const io::Photo> LastPhoto::of(const std::shared_ptr<const EstimateRecord>& record) {
  {
    const std::lock_guard lock(mutex_);
    if (record->decoded) return record->decoded;
  }
  forget();
  auto photo = std::make_shared<const io::Photo>(loaded(*record, limits_));
  const std::lock_guard lock(mutex_);
  record->decoded = photo;
  whose_ = record;
  return photo;
}

void LastPhoto::forget() {
  const std::lock_guard lock(mutex_);
  if (const auto record = whose_.lock()) record->decoded.reset();
  whose_.reset();
}

bool LastPhoto::kept() const {
  const std::lock_guard lock(mutex_);
  const auto record = whose_.lock();
  return record && record->decoded;
}

}  // namespace faceprobe::serve
