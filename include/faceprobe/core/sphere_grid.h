#pragma once
// An equal-area grid of directions: HEALPix, ring order (Gorski et al. 2005, ApJ 622:759). Every cell covers the same solid
// angle, so a solver needs no weights and no pole is special. Rings lie on constant height; the grid's pole is the frame's +y.
//
//   SphereGrid grid(16);                                  // 3072 cells, 3.7 degrees apart
//   int cell = grid.cell_of({0, 0, 1});
//   Eigen::Vector3f centre = grid.direction(cell);
//
// Ring order only; nested order, which needs a power-of-two nside, is not offered.

#include "faceprobe/core/env_map.h"

#include <Eigen/Core>
#include <array>

namespace faceprobe {

class SphereGrid {
 public:
  // 12 nside^2 cells; throws std::invalid_argument unless 1 <= nside <= 512.
  explicit SphereGrid(int nside);

  int nside() const { return nside_; }
  int cell_count() const { return 12 * nside_ * nside_; }
  // The grid that has so many cells. Throws std::invalid_argument when none has.
  static SphereGrid of_cells(Eigen::Index cells);

  double cell_solid_angle() const;  // 4 pi / cell_count(), steradians
  double cell_radius() const;       // radius of the disc of the same solid angle, radians

  // #cells x 3: unit vector through the centre of each cell.
  const Eigen::MatrixX3f& directions() const { return directions_; }
  Eigen::Vector3f direction(int cell) const { return directions_.row(cell).transpose(); }
  // The cell that holds a direction (which need not be of unit length).
  int cell_of(const Eigen::Vector3f& direction) const;

  // Four cells around a direction and their weights (sum 1): linear along the rings above and below, then between them.
  struct Interpolation {
    std::array<int, 4> cell;
    std::array<float, 4> weight;  // 0..1
  };
  // `direction` need not be of unit length.
  Interpolation interpolate(const Eigen::Vector3f& direction) const;

 private:
  struct Ring {
    int first;         // number of the ring's first cell
    int length;        // cells in the ring
    double height;     // y of the cell centres
    double first_phi;  // longitude of the first centre, from +z towards +x, radians
  };
  Ring ring(int index) const;  // index 0 .. 4 nside - 2, from the top
  int ring_count() const { return 4 * nside_ - 1; }

  int nside_;
  Eigen::MatrixX3f directions_;
};

// #cells x 3 mean radiance of the map over each cell. Keeps the integral of every channel exactly.
Eigen::MatrixX3f grid_from_env_map(const EnvMap& map, const SphereGrid& grid);
// The same light on another grid, smooth: each cell the mean of the cells around it, by a Gaussian of half the coarser grid's spacing.
// `cells`: #cells of `from` x 3. Throws std::invalid_argument for another number of rows.
Eigen::MatrixX3f grid_from_grid(const Eigen::MatrixX3f& cells, const SphereGrid& from, const SphereGrid& to);
// Smooth lat-long picture of cell values (#cells of `grid` x 3), interpolated, scaled per channel so that the integral is kept.
// width = 2 * height > 0.
EnvMap env_map_from_grid(const Eigen::MatrixX3f& cells, const SphereGrid& grid, int width, int height);

}  // namespace faceprobe
