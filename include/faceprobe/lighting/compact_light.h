#pragma once
// A light too small for skin to show its size well, such as the sun: known by where it stands, by what it adds to a surface that faces it, and
// roughly by how wide it is. A solver's map spreads it over tens of degrees; with SolveOptions::compact_light the transport
// solver tries it as a disc and says here what it found (Light::compact).
//
//   if (light.compact) add_compact_light(*light.compact, map);   // a sharp sun on a map of what is left
//
// Not for windows and skies: what fits better as something wide stays as the map has it.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/main_lights.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::lighting {

struct CompactLight {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit, camera frame, from the face to the light: its centre
  // Linear Rec.709, radiance x steradian: what it adds on a surface that faces it, on the scale of Light::radiance.
  Eigen::Vector3d irradiance = Eigen::Vector3d::Zero();
  double width_deg = 0;  // across the disc: .5, 5, 10 or 20; the narrowest of those that fit alike
  // How much better the pixels are explained than by the map as it was: twice the logarithm of the ratio of likelihoods.
  double evidence = 0;
};

// Of its disc.
double solid_angle_sr(const CompactLight& light);

// `count` directions evenly over a disc, each for the same share of it: #count x 3, unit. One is the centre. `width_deg`: across, above 0, up to 180.
// Throws std::invalid_argument for another width and for a count below 1.
Eigen::MatrixX3f disc_directions(const Eigen::Vector3d& centre, double width_deg, int count);

// #cells x 3, radiance: the light alone, shared among the cells around each part of it, as core/sky.h does with its sun. Keeps its energy.
Eigen::MatrixX3f compact_cells(const CompactLight& light, const SphereGrid& grid);
// Adds the light to a map of any size, shared among texels likewise; keeps its energy.
void add_compact_light(const CompactLight& light, EnvMap& map);

// Of the main lights of a map that holds the light over its cells, the nearest one, if within 15 degrees, is given the light's direction, size and
// peak; its irradiance stays that of the cells, so that it and without_main_lights() still are all of the light.
void set_true_size(const CompactLight& light, std::vector<MainLight>& lights);

}  // namespace faceprobe::lighting
