#pragma once
// Draws directions from an environment map in proportion to its light, and looks it up fast.
//
//   const MapSampler map(environment);
//   const MapSampler::Seen light = map.draw(random.pair());      // light.radiance / light.density: one sample of the integral
//
// Bilinear look-up is a sum of tents, one a texel, so a texel is drawn first and a place under its tent next: the density is the light
// itself, not a staircase. A part of the map's mean is taken off first, which sampling of surfaces finds as well (MIS compensation, Karlik
// et al. 2019); so density may be 0 where there is light, and only together with another way of sampling is a result right.

#include "faceprobe/core/env_map.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::render {

class MapSampler {
 public:
  explicit MapSampler(const EnvMap& map);

  struct Seen {
    Eigen::Vector3f direction;
    Eigen::Vector3f radiance;
    float density = 0;  // per steradian
  };
  // random: two numbers in [0, 1).
  Seen draw(const Eigen::Vector2f& random) const;
  // direction: unit length.
  Seen look(const Eigen::Vector3f& direction) const;

  // Mean radiance over the sphere, mean of the channels.
  float mean() const { return mean_; }

 private:
  // Place on the map in texels, its left upper corner 0, 0; sine of the angle to the pole there.
  Seen at(const Eigen::Vector3f& direction, float x, float y, float sine) const;

  int width_, height_;
  // Radiance and, as the fourth, density over the map's unit square; a border of one texel on all sides.
  Eigen::Matrix<float, 4, Eigen::Dynamic> texels_;
  std::vector<float> row_before_;     // height + 1: share of the rows above
  std::vector<float> column_before_;  // (width + 1) x height: share of the row to the left
  float mean_ = 0;
};

}  // namespace faceprobe::render
