#pragma once
// The bytes of a regular file. Folders, pipes and devices are refused before they are opened: opening a pipe waits for a
// writer, reading /dev/zero never ends.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::io {

// Throws Error(kInput). `advice` ends the sentence about a file longer than max_bytes.
std::vector<std::byte> read_regular_file(const std::filesystem::path& path, std::int64_t max_bytes,
                                         const std::string& advice);

}  // namespace faceprobe::io
