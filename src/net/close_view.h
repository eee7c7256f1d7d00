#pragma once
// Internal: how the face network looks at a face from near. Networks whose statistics are taken over the whole picture want faces framed as
// in training, so training and use ask here.

#include "faceprobe/core/resample.h"

#include <optional>

namespace faceprobe::net {

// Square of `picture_px` in whose middle the box of the face mask fills this part of the longer side.
constexpr double kCloseFill = 0.8;

// Nothing without a mask (empty, or zero everywhere). `mask`: 1 channel, non-zero on the face.
std::optional<Window> close_window(const ByteImage& mask, int picture_px);

// All of a picture, its longer side `picture_px`.
Window whole_window(int width, int height, int picture_px);

}  // namespace faceprobe::net
