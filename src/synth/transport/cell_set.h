#pragma once
// The cells of a SphereGrid as the transport needs them: directions inside each cell, its neighbours, and an order in which
// consecutive cells lie together, so that a packet of rays stays narrow.

#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace faceprobe::synth {

struct CellSet {
  static constexpr int kQuarters = 4;  // directions spread evenly over a cell, coarse ...
  static constexpr int kParts = 16;    // ... and fine

  explicit CellSet(int nside);

  int count = 0;
  float solid_angle = 0;      // of a cell
  float reach = 0;            // largest angle between a cell's centre and its corners, radians
  Eigen::MatrixX3f centre;    // #cells x 3
  Eigen::MatrixX3f mean;      // #cells x 3: mean direction over the cell, a little shorter than 1
  Eigen::MatrixX3f quarters;  // row kQuarters * cell + i
  Eigen::MatrixX3f parts;     // row kParts * cell + i
  std::vector<std::array<int, 4>> neighbour;
  std::vector<int> order;

  // Mean of (N.L)+ over each cell, scaled so that the sum is 1: the weight of each cell for a white surface under an open sky.
  void cosine_weights(const Eigen::Vector3f& normal, Eigen::ArrayXf& out) const;
};

}  // namespace faceprobe::synth
