#pragma once
// Where the models and meshes that the program needs lie: $FACEPROBE_DATA_DIR if set, else share/faceprobe beside the
// executable's bin folder, else the folders the build was configured with: what set-up fetched, and models/.
//
//   const std::filesystem::path model = io::data_file("face_landmark.tflite");

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::io {

// Full path of a data file such as "face_landmark.tflite". Throws Error(kModel) that names the folders searched and says to
// run scripts/setup.sh.
std::filesystem::path data_file(const std::string& name);
// A file or folder of that name in the first data folder that has one; empty where none has.
std::filesystem::path find_data(const std::string& name);
// The folders that are searched, first to last; they need not exist.
std::vector<std::filesystem::path> data_folders();

// The whole file. Throws Error(kInput) when it cannot be read, is no regular file or is longer than max_bytes.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::int64_t max_bytes);
// The same as a text.
std::string read_text(const std::filesystem::path& path, std::int64_t max_bytes);
// Lower-case hex SHA-256.
std::string sha256_hex(const std::byte* data, std::size_t size);
std::string sha256_hex(const std::string& text);
// Of a whole file. Throws as read_file().
std::string sha256_of_file(const std::filesystem::path& path, std::int64_t max_bytes);

}  // namespace faceprobe::io
