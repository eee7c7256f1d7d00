#pragma once
// A real HDR map, prepared once so that each use of it is cheap: its small bright lights taken out, the rest on equal-area cells, and
// a picture of it for the background. The lights and the rest together hold the map's energy exactly, channel by channel.
//
//   const MapLight map = prepare_map("studio", env_map, {});
//   const LightSample light = light_from_map(map, scene_from_map, gain, SphereGrid(16));

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/light_sample.h"

#include <string>
#include <vector>

namespace faceprobe::synth {

struct MapOptions {
  int max_distant = 6;             // small bright lights taken out; the last one taken may pass this by six parts
  float max_light_radius = 0.04F;  // radians: what is larger, up to two and a half times, is taken out in seven parts
  int nside = 32;                  // of the stored rest

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

struct MapLight {
  std::string name;
  EnvMap radiance;              // as seen, for backgrounds and reflections
  Eigen::MatrixX3f cells;       // 12 nside^2 x 3 mean radiance of the rest, map frame
  Eigen::MatrixX3f directions;  // 12 nside^2 x 3: the cells' centres, map frame
  int nside = 32;
  std::vector<DistantLight> distant;  // map frame
  Eigen::Vector3f mean_radiance;      // of the whole map
  // Texels under the distant lights, and what is there without them.
  struct Covered {
    int x, y;
    Eigen::Vector3f rest;  // radiance, linear
  };
  std::vector<Covered> covered;
};

// Throws Error(kInput) when the map holds NaN, infinity or negative values, or no light at all;
// std::invalid_argument for options that do not validate.
MapLight prepare_map(const std::string& name, const EnvMap& map, const MapOptions& options);

// The map turned into the scene's frame and multiplied by `gain` (exposure and white balance), on the cells of `grid`.
LightSample light_from_map(const MapLight& map, const Eigen::Matrix3f& scene_from_map, const Eigen::Vector3f& gain,
                           const SphereGrid& grid);

// What the camera sees of the map, three channels, camera.width_px x height_px; blur_px = defocus (Gaussian's deviation, up to
// 192). Smoothed over a texel, so that a map much coarser than the picture shows no blocks.
Image draw_background(const MapLight& map, const PinholeCamera& camera, const Eigen::Matrix3f& camera_from_map,
                      const Eigen::Vector3f& gain, float blur_px);

// The map in another frame at another size, its integral kept exactly (lights are splatted, not sampled). Up to a texel the size of
// a stored cell (nside 32: 96 high) it is made from the cells, which is fast; finer ones are looked up in the map itself.
EnvMap map_in_frame(const MapLight& map, const Eigen::Matrix3f& target_from_map, const Eigen::Vector3f& gain, int width,
                    int height);

}  // namespace faceprobe::synth
