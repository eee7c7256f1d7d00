#include "io/exif.h"

#include "faceprobe/io/photo.h"

#include <OpenImageIO/tiffutils.h>
#include <cmath>

namespace faceprobe::io {
namespace {

constexpr int kMaxChunks = 10'000;

std::span<const std::byte> png_exif(const ByteReader& r) {
  std::uint64_t at = 8;
  for (int i = 0; i < kMaxChunks && r.has(at, 12); ++i) {
    const std::uint32_t size = r.u32(at);
    if (!r.has(at + 8, size)) break;
    if (r.matches(at + 4, "eXIf")) return r.bytes().subspan(at + 8, size);
    at += 12 + std::uint64_t{size};
  }
  return {};
}

std::span<const std::byte> webp_exif(const ByteReader& r) {
  std::uint64_t at = 12;
  for (int i = 0; i < kMaxChunks && r.has(at, 8); ++i) {
    const std::uint32_t size = r.u32(at + 4);
    if (!r.has(at + 8, size)) break;
    if (r.matches(at, "EXIF")) {
      // Some writers keep the JPEG marker's name in front.
      const std::uint64_t skip = r.matches(at + 8, std::string_view("Exif\0\0", 6)) && size >= 6 ? 6 : 0;
      return r.bytes().subspan(at + 8 + skip, size - skip);
    }
    at += 8 + std::uint64_t{size} + (size & 1);
  }
  return {};
}

// Finite and positive, or nothing.
std::optional<double> positive(const OIIO::ImageSpec& spec, const char* name) {
  const double value = spec.get_float_attribute(name, 0.0F);
  if (!std::isfinite(value) || value <= 0) return std::nullopt;
  return value;
}

// Pixels per millimetre on the sensor, of the picture as it was taken.
std::optional<double> sensor_pixels_per_mm(const OIIO::ImageSpec& spec) {
  const std::optional<double> resolution = positive(spec, "Exif:FocalPlaneXResolution");
  if (!resolution) return std::nullopt;
  switch (spec.get_int_attribute("Exif:FocalPlaneResolutionUnit", 2)) {
    case 2: return *resolution / 25.4;  // inch
    case 3: return *resolution / 10.0;  // centimetre
    case 4: return *resolution;         // millimetre
    default: return std::nullopt;
  }
}

}  // namespace

OIIO::ImageSpec with_exif(const OIIO::ImageSpec& spec, const Header& header, std::span<const std::byte> bytes) {
  OIIO::ImageSpec completed = spec;
  if (spec.find_attribute("Orientation") != nullptr || spec.find_attribute("Exif:FocalLength") != nullptr)
    return completed;
  std::span<const std::byte> block;
  if (header.format == "png") block = png_exif(ByteReader(bytes, ByteOrder::kBig));
  if (header.format == "webp") block = webp_exif(ByteReader(bytes, ByteOrder::kLittle));
  constexpr std::size_t kTiffHeader = 8;
  if (block.size() > kTiffHeader) {
    OIIO::decode_exif(OIIO::string_view(reinterpret_cast<const char*>(block.data()), block.size()), completed);
    OIIO::geterror();
  }
  return completed;
}

int exif_orientation(const OIIO::ImageSpec& spec) {
  const int found = spec.get_int_attribute("Orientation", 1);
  return found >= 1 && found <= 8 ? found : 1;
}

std::optional<double> exif_focal_px(const OIIO::ImageSpec& spec) {
  const double diagonal = std::hypot(spec.width, spec.height);
  std::optional<double> focal;
  if (const auto film_mm = positive(spec, "Exif:FocalLengthIn35mmFilm")) {
    focal = *film_mm * diagonal / kFilmDiagonalMm;
  } else if (const auto lens_mm = positive(spec, "Exif:FocalLength")) {
    if (const auto per_mm = sensor_pixels_per_mm(spec)) {
      // The pitch belongs to the picture as taken; this one may have been made smaller since.
      const double taken_width = positive(spec, "Exif:PixelXDimension").value_or(spec.width);
      focal = *lens_mm * *per_mm * spec.width / taken_width;
    }
  }
  // From a circular fisheye (0.2 of the diagonal) to an 860 mm lens: beyond, the numbers are wrong.
  if (!focal || *focal < 0.2 * diagonal || *focal > 20 * diagonal) return std::nullopt;
  return focal;
}

}  // namespace faceprobe::io
