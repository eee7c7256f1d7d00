#pragma once
// The photo that was worked on last, decoded: what is drawn into a photo follows its estimate more often than not. As linear light in floats it is
// many times its file's size, so there is never more than one, and it goes with its record. Safe from several threads.
//
//   LastPhoto last(limits);
//   const std::shared_ptr<const io::Photo> photo = last.of(record);

#include "faceprobe/io/limits.h"
#include "faceprobe/io/photo.h"
#include "serve/records.h"

#include <memory>
#include <mutex>

namespace faceprobe::serve {

class LastPhoto {
 public:
  explicit LastPhoto(io::Limits limits) : limits_(limits) {}

  // Decoded unless it is the one that is kept; another that was is let go of first. Throws what io::load_photo throws, with the record's name in
  // the place of the file's.
  std::shared_ptr<const io::Photo> of(const std::shared_ptr<const EstimateRecord>& record);
  void forget();
  bool kept() const;  // whether there is one

 private:
  io::Limits limits_;
  mutable std::mutex mutex_;                   // of this and of its record's `decoded`
  std::weak_ptr<const EstimateRecord> whose_;  // the record holds the photo, this does not hold the record
};

}  // namespace faceprobe::serve
