#pragma once
// Internal: what skin_subspace keeps of each pixel of the mask, and the colours skin can have.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace faceprobe::highlight {

// Log albedo of medium skin (linear Rec.709) and the directions, of unit length, in which it moves with more melanin and more blood:
// a two-layer Kubelka-Munk model with the absorption of melanosomes (Jacques 1998) and of haemoglobin (Prahl 1999), epidermis of
// 60 um, evaluated at 5 % melanosomes and 3 % blood. The figures are those of src/synth/skin/tone.cpp, where the model is.
struct SkinColours {
  Eigen::Vector3f mean{-0.81533F, -1.23728F, -1.60842F};
  Eigen::Vector3f melanin{-0.41502F, -0.53595F, -0.73520F};
  Eigen::Vector3f haemoglobin{-0.40043F, -0.75073F, -0.52542F};
};

using Harmonics = Eigen::Matrix<float, 9, 1>;     // values of order 2 in the order of core/sh.h
using ShadingModel = Eigen::Matrix<float, 9, 3>;  // coefficients; their sum with a normal's values is irradiance / pi

struct SkinPixel {
  std::size_t index = 0;  // in the picture
  Eigen::Vector3f colour;
  bool used[3] = {};  // channels that are neither clipped nor black
  float facing = 1;   // normal . viewer
  Harmonics normal_basis, mirror_basis;

  Eigen::Vector3f shading, light;  // light: colour, mean 1
  float expected_highlight = 0;
  float highlight = 0;     // amount of `light`
  float log_ratio = 0;     // of highlight to the expected one
  Eigen::Vector3f around;  // log albedo and shading of the surroundings, less those of the model
  Eigen::Vector3f own;     // of this pixel
  bool seen() const { return used[0] || used[1] || used[2]; }
};

// The pixels of the mask that are not black, row by row.
std::vector<SkinPixel> skin_pixels(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                                   const Image& normal_cam);

}  // namespace faceprobe::highlight
