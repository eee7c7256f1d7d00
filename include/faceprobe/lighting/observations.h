#pragma once
// What a face says about the light, reduced to rows: for each small patch of skin where it faces, how it was seen, and how much
// light it mirrored and scattered. All vectors are in the camera frame, all colours linear Rec.709 with 1 = the photo's white.
//
// Plain data; fill it from any source of normals and layers. A sphere, a scan or a rendering do as well as a photo.
//
//   Observations ball;
//   ball.resize(patches);                                   // then fill normal, view, highlight, shading row by row
//   const Light light = solve(ball, {});                    // lighting/estimate.h

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace faceprobe::lighting {

// Azimuths, counter-clockwise in the image plane from +x, at which a patch's horizon is stored.
inline constexpr int kHorizonAzimuths = 32;
// A horizon's tangent where nothing blocks: below every light, and finite, so that sums with it are.
inline constexpr float kNothingBlocks = -1e6F;

struct Observations {
  Eigen::MatrixX3f normal;     // #patches x 3, unit
  Eigen::MatrixX3f view;       // #patches x 3, unit, from the surface to the camera
  Eigen::MatrixX3f highlight;  // #patches x 3
  Eigen::MatrixX3f shading;    // #patches x 3: diffuse layer divided by albedo; irradiance / pi
  // #patches x 3: what the shading would be if nothing blocked the light and nothing sent it back, neither the face nor hair nor shoulders.
  // The transport solver explains it in the place of the shading. Empty = not known.
  Eigen::MatrixX3f open_shading;
  // #patches x 3, true where the photo clipped the channel (in pipeline::observe: in over a quarter of the patch): lower bounds there.
  Eigen::Array<bool, Eigen::Dynamic, 3> clipped;
  Eigen::VectorXf roughness;        // #patches, Beckmann m
  Eigen::VectorXf specular_albedo;  // #patches, rho_s
  Eigen::VectorXf weight;           // #patches, 0 or more: less where the geometry is doubtful; 0 = not looked at
  // #patches x kHorizonAzimuths: tangent of the elevation (over the image plane, towards +z) under which light is blocked by
  // the face itself. Empty = nothing blocks.
  Eigen::MatrixXf horizon;
  // The picture has no colour. Its light is grey then, also where it is expected and not observed.
  bool grey = false;

  Eigen::Index count() const { return normal.rows(); }
  // All rows 0, unclipped, of weight 1, with the roughness and specular albedo of average skin; no horizon, not grey.
  void resize(Eigen::Index patches);
  // Empty when usable, else a sentence that says what is missing.
  std::string validate() const;
};

// One set after the other. Sets with and without horizon mix; where there is none, nothing blocks. Grey if all of them are; an open shading if all have one.
Observations concatenate(const std::vector<Observations>& sets);

// Whether there are highlights to speak of: a twentieth at least of what skin mirrors of the light that its shading shows, looked at straight on
// (rho_s F0 times the shading). Every lamp makes it more than that, from the viewer's side the least (1.7 times, on an ellipsoid like a face).
// Less is a layer without highlights: skin that is powdered or smoothed by a filter, or a separator that found none. False without patches.
bool shows_highlights(const Observations& observations);

}  // namespace faceprobe::lighting
