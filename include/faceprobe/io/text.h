#pragma once
// Captions on pictures, in DejaVu Sans through OpenImageIO's FreeType. When the font is not installed the text is left out
// and draw_text returns false: a missing caption must not cost anybody an environment map.
//
//   io::draw_text(sheet, 12, 30, "diffuse", 18, {255, 255, 255});

#include "faceprobe/core/image.h"

#include <array>
#include <cstdint>
#include <string>

namespace faceprobe::io {

// Draws UTF-8 text with its baseline's left end at (x, y) px on a three-channel picture. height_px is the font's em size;
// `colour` is sRGB. Returns whether it was drawn. Throws std::invalid_argument for other channels or a height below 1.
bool draw_text(ByteImage& picture, int x, int y, const std::string& text, int height_px,
               const std::array<std::uint8_t, 3>& colour, bool bold = false);

}  // namespace faceprobe::io
