#pragma once
// Internal: another view of a training picture: a part of it enlarged, all of it made smaller, or its sides cut off.

#include "train/augment.h"

namespace faceprobe::train {

// The picture enlarged by `zoom` about a point, in pixels; below 1 it shrinks and is black around. Light is interpolated linearly,
// flags and masks are those of the nearest pixel. What lies outside is as photos are outside their edges (face::crop_picture): black,
// marked as clipped, no skin; the face mask goes on there, because the mesh does.
TrainingPicture zoomed(const TrainingPicture& picture, double zoom, double centre_x, double centre_y);

// Columns and rows that a photo shows, [first, last).
struct ShownPart {
  int left = 0, top = 0, right = 0, bottom = 0;
};
void cut_sides(const ShownPart& shown, TrainingPicture& picture);

}  // namespace faceprobe::train
