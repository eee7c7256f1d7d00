#pragma once
// A file that appears whole or not at all: written under a temporary name in the target's folder, flushed to the disk, then
// renamed over the target. A process that dies in between leaves the target as it was.
//
//   write_file_atomically("report.json", text);

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

namespace faceprobe::io {

// Here and below: throws Error(kOutput) naming the target and the system's reason; the old target is untouched then.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);
// For libraries that write by name: `write` is handed the temporary path (same extension as the target) and fills it.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write);

// Creates the folder and its parents. Throws Error(kOutput).
void create_folder(const std::filesystem::path& folder);

}  // namespace faceprobe::io
