#pragma once
// Where a face is in its photo, for networks that see nothing else (light_regressor.h).
//
//   const std::optional<Window> window = net::face_window(mask, 96);
//   if (window) crop = resampled(linear, *window, Outside::kEdge);   // 96 x 96

#include "faceprobe/core/image.h"
#include "faceprobe/core/resample.h"

#include <optional>

namespace faceprobe::net {

// The square around a face's mask (H x W x 1, its pixels not zero) with a margin, at a side of `px`: what "legendre" has learnt to look at.
// Nothing where the mask is empty. It may reach beyond the picture.
std::optional<Window> face_window(const ByteImage& mask, int px);

}  // namespace faceprobe::net
