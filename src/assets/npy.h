#pragma once
// NumPy's array files (.npy, format 1.0 and 2.0) and archives of them (.npz). Not read: object arrays, big-endian values, column-major
// order, complex and text.

#include "assets/array.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace faceprobe::assets {

using Arrays = std::map<std::string, Array>;

// `name` is for the sentence of the Error(kInput): not an array file, cut off, of another type or order.
Array parse_npy(std::span<const std::byte> bytes, const std::string& name);
Array read_npy(const std::filesystem::path& path);
// All arrays of an .npz, by name without ".npy".
Arrays read_npz(const std::filesystem::path& path);

}  // namespace faceprobe::assets
