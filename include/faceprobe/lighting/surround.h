#pragma once
// What the photo shows around a face, ring by ring: light that comes from behind the head, which the skin in view does not see. Mostly hair,
// clothes and a part of the scene; as a mirror of what is there it is worth little, as a hint at how bright it is behind, much.
//
//   Observations o = ...;
//   o.surround = surround_of(photo.linear, centre_px, half_height_px);
//
// Not for photos that were cut out and put before another background.

#include "faceprobe/core/image.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

inline constexpr int kSurroundRings = 3;
inline constexpr int kSurroundAngles = 12;
inline constexpr int kSurroundSectors = kSurroundRings * kSurroundAngles;

// A sector a row, ring by ring from the inside, counter-clockwise in the picture from just above +x: mean linear red, green and blue, the
// share of its pixels where a channel is at white, and the share of it that lies in the picture (0: the other four are 0 too).
using Surround = Eigen::Matrix<float, kSurroundSectors, 5, Eigen::RowMajor>;

// `linear`: H x W x 3, the whole photo. `centre_px`, `half_height_px`: of the face from forehead to chin, in its pixels; the rings' radii are
// 1.2, 1.6, 2.2 and 3.2 half heights. Looks at some hundred pixels a sector at most, so that it costs the same for photos of any size.
// Throws std::invalid_argument for a picture of other channels and a height that is not above 0.
Surround surround_of(const Image& linear, const Eigen::Vector2f& centre_px, float half_height_px);

// The same of the mirror image: left and right changed places.
Surround mirrored(const Surround& surround);

}  // namespace faceprobe::lighting
