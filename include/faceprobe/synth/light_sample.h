#pragma once
// Light in a scene's frame as the transport takes it: a smooth part on equal-area cells and a few small bright lights apart, whose
// direction and energy are kept exactly. Together they are the map's whole energy.
//
//   LightSample sky{.cells = grid_from_env_map(map, SphereGrid(16))};
//   sky.near.push_back({.position = {0.5F, 0.2F, 0.8F}, .radiance = {40, 36, 30}});

#include <Eigen/Core>
#include <vector>

namespace faceprobe::synth {

struct DistantLight {
  Eigen::Vector3f direction;   // unit length, towards the light
  Eigen::Vector3f irradiance;  // linear RGB, on a surface that faces it: radiance x solid angle
};

// A lamp at a place: a sphere of even radiance.
struct NearLight {
  Eigen::Vector3f position;  // metres
  float radius = 0.05F;      // metres, > 0
  Eigen::Vector3f radiance;  // linear RGB
};

struct LightSample {
  Eigen::MatrixX3f cells;  // #cells of core/sphere_grid.h x 3, mean radiance
  std::vector<DistantLight> distant;
  std::vector<NearLight> near;
};

}  // namespace faceprobe::synth
