#pragma once
// The dense face mesh itself as a head model: a mask of 468 vertices whose landmarks are its vertices.

#include "faceprobe/face/face.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/synth/head_model.h"

#include <functional>

namespace faceprobe::pipeline::testing {

synth::HeadModel mask_head();

// A photo of it with everything known: turned by yaw_deg, half a metre away, 200 px wide. `radiance` gets UV and normal (camera frame).
struct MaskPhoto {
  io::Photo photo;
  face::Face face;
  face::Camera camera;
};
using Radiance = std::function<Eigen::Vector3f(const Eigen::Vector2f& uv, const Eigen::Vector3f& normal)>;
MaskPhoto mask_photo(double yaw_deg, const Radiance& radiance);

}  // namespace faceprobe::pipeline::testing
