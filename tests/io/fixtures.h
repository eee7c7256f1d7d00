#pragma once
// Small files that the io tests make for themselves.

#include "faceprobe/core/image.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::io::testing {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

using Bytes = std::vector<std::byte>;

Bytes slurp(const std::filesystem::path& path);
void spit(const std::filesystem::path& path, std::span<const std::byte> bytes);
Bytes to_bytes(std::string_view text);
// Appends a number of `count` bytes.
void put_big(Bytes& bytes, std::uint64_t value, int count);
void put_little(Bytes& bytes, std::uint64_t value, int count);
void put_text(Bytes& bytes, std::string_view text);

// Writes with OpenImageIO's writer of that name, whatever the extension. Fails the test on an error.
void write_with(const std::string& format, const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                OIIO::TypeDesc type, const void* values);
void write_bytes(const std::string& format, const std::filesystem::path& path, const ByteImage& image,
                 const OIIO::ParamValueList& attributes = {});

// Four flat quadrants of different colours, 32 x 48 px: tells all eight orientations apart, survives JPEG away from edges.
ByteImage quadrants();
// Smooth picture with every level of each channel.
ByteImage gradient(int width, int height, int channels);

}  // namespace faceprobe::io::testing
