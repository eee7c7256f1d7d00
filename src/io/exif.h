#pragma once
// What the EXIF block says about the picture's orientation and the lens.

#include "io/header_peek.h"

#include <OpenImageIO/imageio.h>
#include <cstddef>
#include <optional>
#include <span>

namespace faceprobe::io {

// The decoder's attributes, completed from the EXIF chunks of PNG and WebP, which OpenImageIO 2.4 passes over.
OIIO::ImageSpec with_exif(const OIIO::ImageSpec& spec, const Header& header, std::span<const std::byte> bytes);

// 1..8; 1 when the file does not say, or says nonsense.
int exif_orientation(const OIIO::ImageSpec& spec);

// Focal length in pixels of this picture. From the 35 mm equivalent by the diagonal, as CIPA DCG-001 defines it; else from the focal
// length and the sensor's pixel pitch.
std::optional<double> exif_focal_px(const OIIO::ImageSpec& spec);

}  // namespace faceprobe::io
