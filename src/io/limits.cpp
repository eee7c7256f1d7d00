#include "faceprobe/io/limits.h"

namespace faceprobe::io {

std::string Limits::validate() const {
  if (max_file_bytes < 1)
    return "The limit on file bytes must be at least 1, not " + std::to_string(max_file_bytes) + ".";
  if (max_pixels < 1) return "The limit on pixels must be at least 1, not " + std::to_string(max_pixels) + ".";
  // Pixel offsets are computed in int by callers that work on one row or column.
  if (max_side_px < 1 || max_side_px > (1 << 20)) {
    return "The limit on a side must be 1 to 1048576 px, not " + std::to_string(max_side_px) + ".";
  }
  if (max_channels < 1) return "The limit on channels must be at least 1, not " + std::to_string(max_channels) + ".";
  if (max_jpeg_scans < 1)
    return "The limit on JPEG scans must be at least 1, not " + std::to_string(max_jpeg_scans) + ".";
  if (max_icc_bytes < 0)
    return "The limit on ICC bytes must not be negative, but is " + std::to_string(max_icc_bytes) + ".";
  if (!(max_expansion >= 1))
    return "The limit on expansion must be at least 1, not " + std::to_string(max_expansion) + ".";
  if (expansion_free_bytes < 0) {
    return "The size free of the expansion limit must not be negative, but is " + std::to_string(expansion_free_bytes) +
           ".";
  }
  return {};
}

}  // namespace faceprobe::io
