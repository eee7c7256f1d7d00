#pragma once
// What the raw channels of the face network mean. Its input is that of the highlight network (head.h), and so are its first four outputs;
// torch/face_head.h reads them for training, face_layers.cpp for use.

#include "faceprobe/core/region.h"

namespace faceprobe::net {

struct FaceOutputs {
  static constexpr int kHighlight = 0;  // amount; colour red, green, blue: see head.h
  static constexpr int kNormal = 4;     // x, y, z - 1, of any length: a network that says nothing gives the viewer's direction
  static constexpr int kSpread = 7;     // logarithm of the normal's expected error over kUsualError
  static constexpr int kDepth = 8;      // of kDepthUnit, larger = further away, from any origin
  static constexpr int kShading = 9;    // logarithm of the mean of the channels; colour red, green, blue as the highlight's
  static constexpr int kRegion = 13;    // of each Region a score; the largest is meant
  static constexpr int kCount = kRegion + kRegionCount;

  static constexpr double kUsualError = 0.15;  // radians
  static constexpr double kDepthUnit = 0.05;   // metres
  static constexpr double kLargestLog = 8;     // of the spread and the shading, either sign
  static constexpr double kShortest = 1e-6;    // of a normal, before it is made a unit
};

}  // namespace faceprobe::net
