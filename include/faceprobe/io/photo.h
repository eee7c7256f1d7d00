#pragma once
// A photo as light: decoded by content (not by extension), turned upright once, converted to linear Rec.709 through its ICC
// profile, with the pixels that the sensor or the encoder clipped marked before any conversion hides them.
//
// Reads JPEG, PNG (8 and 16 bit), TIFF, WebP, HEIC, OpenEXR and Radiance HDR. Does not read CMYK, Lab, animation frames past
// the first, or raw sensor data. EXR and HDR are taken as linear already; NaN, infinite and negative values become 0 and are
// counted in `warnings`.
//
//   const io::Photo photo = io::load_photo("portrait.jpg");
//   float red = photo.linear(x, y, 0);            // 1 = the photo's white
//   bool red_clipped = photo.clipped(x, y) & 1;

#include "faceprobe/core/image.h"
#include "faceprobe/io/limits.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::io {

// Bits of Photo::clipped.
inline constexpr std::uint8_t kClippedRed = 1;
inline constexpr std::uint8_t kClippedGreen = 2;
inline constexpr std::uint8_t kClippedBlue = 4;
inline constexpr std::uint8_t kTransparent = 8;  // alpha < 1: the colour here is not the camera's

// Diagonal of a 36 x 24 mm frame, to 0.01 mm: by it focal lengths are made 35 mm equivalents (CIPA DCG-001).
inline constexpr double kFilmDiagonalMm = 43.27;

struct Photo {
  Image linear;       // H x W x 3, linear Rec.709, upright
  ByteImage clipped;  // H x W x 1, the bits above
  bool grey = false;  // the file has one colour channel, or three that are equal everywhere
  int bits_per_channel = 8;
  std::string format;              // "jpeg", "png", "tiff", "webp", "heif", "exr", "hdr"
  std::string colour_space;        // what the file says, e.g. "sRGB (assumed)", "Display P3", "linear"
  int exif_orientation = 1;        // 1..8 as found; already applied
  std::optional<double> focal_px;  // from EXIF: 35 mm equivalent (diagonal convention) scaled to this picture, in pixels
  std::vector<std::string> warnings;  // sentences for the report
  std::string sha256;                 // of the file's bytes, hex
};

// Throws Error(kInput) with the reason when the file is not readable, not a picture, of an unsupported kind, or over a limit;
// Error(kUsage) for limits that do not validate.
Photo load_photo(const std::filesystem::path& path, const Limits& limits = {});

// A picture that is decoded already: sRGB, H x W x 3, upright. Throws std::invalid_argument for another number of channels.
Photo photo_from_srgb(const ByteImage& srgb);

// What this installation reads, by Photo::format: a build of OpenImageIO may lack one, HEIC mostly.
std::vector<std::string> photo_formats();

}  // namespace faceprobe::io
