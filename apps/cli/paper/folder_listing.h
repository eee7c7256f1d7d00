#pragma once
// What lies in a folder, as a text that a copy of it shares, wherever it lies and whenever it was made.
//
//   const std::string before = listing_of("data/real");

#include <filesystem>
#include <string>

namespace faceprobe::cli {

// One line a file, in the order of the names: its path below the folder, its size, and a hash of its bytes. Of a file of 1 MiB or more only the
// first and the last 64 KiB are read: a change between them that keeps the size is not seen. Empty for what is no folder.
std::string listing_of(const std::filesystem::path& folder);

}  // namespace faceprobe::cli
