#pragma once
// Arrays and text of an HDF5 file.

#include "assets/array.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace faceprobe::assets {

class Hdf5File {
 public:
  // Throws Error(kInput) when it is no HDF5 file.
  explicit Hdf5File(const std::filesystem::path& path);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  const std::string& name() const { return name_; }  // quoted, for sentences
  bool has(const std::string& dataset) const;        // such as "shape/model/mean"
  // Throws Error(kInput): missing, not numbers, over 2 GiB.
  Array array(const std::string& dataset) const;
  // Text of fixed or variable length; empty when it is not there.
  std::string text(const std::string& dataset) const;

 private:
  std::string name_;
  std::int64_t file_ = -1;
};

}  // namespace faceprobe::assets
