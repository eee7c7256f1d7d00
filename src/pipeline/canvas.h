#pragma once
// Drawing for the overview and the label pictures: sRGB bytes on a canvas, nothing that measures.

#include "faceprobe/core/image.h"
#include "faceprobe/face/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace faceprobe::pipeline {

using Colour = std::array<std::uint8_t, 3>;

inline constexpr Colour kPaper = {24, 25, 28};
inline constexpr Colour kInk = {226, 228, 232};

// Copies a three-channel picture so that its top left corner is at (x, y); what does not fit is cut.
void paste(ByteImage& canvas, const ByteImage& picture, int x, int y);
// Anti-aliased line of about 1 px, mixed with the canvas by `opacity` 0..1.
void draw_line(ByteImage& canvas, Eigen::Vector2d from, Eigen::Vector2d to, const Colour& colour, float opacity = 1.0F);
void draw_ring(ByteImage& canvas, Eigen::Vector2d centre, double radius, const Colour& colour, float opacity = 1.0F);
// Filled rectangle.
void fill(ByteImage& canvas, int x, int y, int width, int height, const Colour& colour);
// Resized to the given size by area average or bilinear interpolation.
Image resized(const Image& image, int width, int height);
ByteImage resized_labels(const ByteImage& labels, int width, int height);  // nearest

// Exposure that shows a layer well: its 99 % quantile over non-black pixels at .8.
float display_gain(const Image& layer);
// (n + 1) / 2 as colours, not gamma-encoded, as normal maps are; black off the face.
ByteImage normals_picture(const face::FaceGeometry& geometry);
ByteImage regions_picture(const face::FaceGeometry& geometry);

}  // namespace faceprobe::pipeline
