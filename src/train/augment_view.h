#pragma once
// Internal: another view of a training picture: a part of it enlarged, all of it made smaller, or its sides cut off.

#include "faceprobe/core/resample.h"
#include "train/augment.h"

namespace faceprobe::train {

// What is seen through a window. Light is averaged, flags and masks are those of the nearest pixel. What lies outside is as photos are outside
// their edges (face::crop_picture): black, marked as clipped, no skin; the face mask goes on there, because the mesh does.
TrainingPicture seen_through(const Window& window, const TrainingPicture& picture);

// A window as large as the picture that enlarges it by `zoom` about a point, in pixels; below 1 it shows what is around.
Window zoom_window(const TrainingPicture& picture, double zoom, double centre_x, double centre_y);

// Columns and rows that a photo shows, [first, last).
struct ShownPart {
  int left = 0, top = 0, right = 0, bottom = 0;
};
void cut_sides(const ShownPart& shown, TrainingPicture& picture);

}  // namespace faceprobe::train
