#pragma once
// Where up is in a photo, and places in front of its camera.
//
//   const Eigen::Vector3f up = up_from_heads({face_up});
//   const Eigen::Vector3f foot = point_at(view, 900, 1200, 0.8F);          // on the ray through that pixel, .8 m away

#include "faceprobe/core/pixel_box.h"
#include "faceprobe/render/path_tracer.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace faceprobe::insert {

// Up in the camera's frame, unit, when the horizon runs through the picture at this height in its middle column, and is level.
Eigen::Vector3f up_from_horizon(const render::PinholeView& view, double horizon_y_px);

// Up from the way heads are held, each the direction from chin to crown, camera frame; +y without any. Cameras are held level to about 8 degrees,
// heads upright to about 12, and the answer is what these two make likeliest: one bent head moves it by a third of its bend, a row of heads that
// agree by nearly all.
Eigen::Vector3f up_from_heads(const std::vector<Eigen::Vector3f>& heads);

// The point on the ray through (x_px, y_px) at that depth along -z: metres, camera frame.
Eigen::Vector3f point_at(const render::PinholeView& view, double x_px, double y_px, float depth_m);

// The part of the photo that a box (metres, camera frame) may show in; empty when that is outside, or wholly behind the camera.
std::optional<PixelBox> box_in_view(const render::PinholeView& view, const Eigen::AlignedBox3f& box);

}  // namespace faceprobe::insert
