#pragma once
// What goes into the face network and what its raw channels mean. torch/face_head.h writes and reads them for training, face_layers.h for
// use. The first seven inputs and the first four outputs are those of the highlight network (head.h).

#include "faceprobe/core/region.h"

namespace faceprobe::net {

struct FaceInputs {
  static constexpr int kMesh = 7;  // the mesh's normals x, y, z, zero off the mesh
  static constexpr int kCount = 10;
  // The picture is brought to this mean luminance of the face (of everything without a mask), and the shading back: half the light gives half
  // of every layer.
  static constexpr double kMiddle = 0.25;
  static constexpr double kDarkest = 1e-4;  // of a face; below, it is left too dark
};

struct FaceOutputs {
  static constexpr int kHighlight = 0;  // amount; colour red, green, blue: see head.h
  static constexpr int kNormal =
      4;  // x, y, z - 1, of any length: a network that says nothing gives the viewer's direction
  static constexpr int kSpread = 7;  // logarithm of the normal's expected error over kUsualError
  static constexpr int kDepth = 8;   // of kDepthUnit, larger = further away, from any origin
  static constexpr int kShading =
      9;  // logarithm of the mean of the channels, of the picture as it went in; colour red, green, blue as the highlight's
  static constexpr int kRegion = 13;  // of each Region a score; the largest is meant
  static constexpr int kCountWithoutOpen =
      kRegion + kRegionCount;  // networks that were trained before there was the next
  static constexpr int kOpen =
      kCountWithoutOpen;  // as kShading: of what the shading would be if nothing stood in the light's way
  static constexpr int kCount = kOpen + 4;

  static constexpr double kUsualError = 0.15;  // radians
  static constexpr double kDepthUnit = 0.05;   // metres
  static constexpr double kLargestLog = 8;     // of the spread and the shading, either sign
  static constexpr double kShortest = 1e-6;    // of a normal, before it is made a unit
};

}  // namespace faceprobe::net
