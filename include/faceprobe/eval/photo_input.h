#pragma once
// What the benchmarks on synthetic photos give a method to see.
//
//   const eval::HighlightMethod mine{"mine", [](const eval::PhotoInput& input) { return highlight_of(input.linear); }};

#include "faceprobe/core/image.h"
#include "faceprobe/face/face.h"

namespace faceprobe::eval {

// H x W each. Where the face mesh was looked for in the data (`faceprobe mesh`) mask and mesh are those an estimate would have; the mask is
// all of the photo then where no face was found. Without, the mask is the outline of the landmarks and there is no mesh.
struct PhotoInput {
  const Image& linear;           // 3 channels: the photo, decoded
  const ByteImage& photo;        // 3 channels, sRGB: the same
  const ByteImage& clip;         // 1 channel, bits of the clipped channels
  const ByteImage& mask;         // 1 channel: the face
  const Image& mesh_normal_cam;  // 3 channels, 0 off the mesh; empty = no mesh
  const ByteImage& region;       // 1 channel, the true Region, for methods that have to be given it
  face::Camera camera;
};

}  // namespace faceprobe::eval
