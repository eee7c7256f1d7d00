#pragma once
// An embedded ICC profile as a ColourModel to linear Rec.709, relative colorimetric: the photo's white becomes (1, 1, 1) and
// no perceptual rendering bends the light.

#include "io/colour_model.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace faceprobe::io {

// For pictures of 1 or 3 channels and 256, 65536 or 0 (float) code values. Empty, with the reason in `problem`, when the
// profile is damaged or is not for such a picture.
std::optional<ColourModel> model_from_icc(std::span<const std::byte> profile, int channels, std::size_t levels,
                                          std::string& problem);

}  // namespace faceprobe::io
