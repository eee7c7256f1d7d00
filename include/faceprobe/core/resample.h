#pragma once
// A part of a picture at another scale: light is averaged, labels and flags are those of the nearest pixel.
//
//   const Window face{.left_px = 40, .top_px = 30, .scale = 1.5, .width = 96, .height = 96};
//   const Image close = resampled(photo, face);                                // 96 x 96, shows 64 x 64 of the photo
//   const Image back = resampled(close, face.back_to(photo.width(), photo.height()));
//
// For small pictures and modest scales: it takes (1 / scale)^2 samples for a pixel. face::crop_picture shrinks photos.

#include "faceprobe/core/image.h"

#include <optional>

namespace faceprobe {

// Pixel (x, y) of the part has its centre at (left_px + (x + .5) / scale, top_px + (y + .5) / scale) of the picture.
struct Window {
  double left_px = 0, top_px = 0;
  double scale = 1;  // pixels of the part to a pixel of the picture, > 0
  int width = 0, height = 0;

  // The window through which the part shows the picture again, as large as that was.
  Window back_to(int picture_width, int picture_height) const {
    return {-left_px * scale, -top_px * scale, 1 / scale, picture_width, picture_height};
  }
};

enum class Outside : std::uint8_t { kBlack, kEdge };

// The whole of a picture of that size, its longer side `long_side_px` at most; of one that is no larger as it is.
Window shrunk(int width, int height, int long_side_px);

// Linear between pixels, the mean over each pixel where it shrinks. Outside the picture black, or as its nearest pixel.
Image resampled(const Image& picture, const Window& window, Outside outside = Outside::kBlack);

// Outside the picture `outside`, or its nearest pixel's.
ByteImage resampled(const ByteImage& labels, const Window& window, std::optional<std::uint8_t> outside = std::nullopt);

// Numbers between which there is nothing, such as depth: each the nearest pixel's; 0 outside the picture.
Image nearest(const Image& picture, const Window& window);

}  // namespace faceprobe
