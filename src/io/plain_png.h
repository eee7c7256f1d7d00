#pragma once
// A PNG file made without a library: its rows are not compressed. For builds that have no encoder; two to four times as large as need be.

#include "faceprobe/core/image.h"

#include <cstddef>
#include <vector>

namespace faceprobe::io {

// Encoded bytes of 1, 3 or 4 channels, at least one pixel; std::invalid_argument for others (PNG, third edition; RFC 1950, 1951).
std::vector<std::byte> plain_png(const ByteImage& image);

}  // namespace faceprobe::io
