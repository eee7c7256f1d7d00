#pragma once
// Internal: gives values to the cells of a sphere grid around many directions, and takes them back. As SphereGrid::interpolate, but
// with tables and without trigonometry, so that a map of 12,288 cells is turned in a fraction of a millisecond; between two rings
// the weight is linear in the ring's number, which is linear in height on the belt and nearly in angle in the caps.

#include <Eigen/Core>
#include <vector>

namespace faceprobe::synth {

// Four floats a cell, so that one addition takes in all channels.
using CellSums = std::vector<Eigen::Vector4f>;

class CellLattice {
 public:
  explicit CellLattice(int nside);

  CellSums zero() const { return CellSums(static_cast<std::size_t>(12 * nside_ * nside_), Eigen::Vector4f::Zero()); }

  // Spreads the values (#d x 3) at target_from_source * directions (#d x 3, unit length) over the cells there. Keeps their sum.
  void add(const Eigen::MatrixX3f& directions, const Eigen::Matrix3f& target_from_source,
           const Eigen::MatrixX3f& values, CellSums& sums) const;

  // The number of a ring, with a fraction, at a height (y of a unit vector).
  float ring_at(float height) const;
  // Between the cells around a place; `turn` from +z towards +x, 0 .. 1.
  Eigen::Vector4f sample(const CellSums& cells, float ring, float turn) const;

 private:
  struct Ring {
    int first;    // number of its first cell
    int length;   // cells
    float shift;  // place of the first centre, in cells from +z
  };
  struct Pair {
    std::size_t cell, next;
    float part;  // of the way from the one to the other
  };
  static Pair along(const Ring& ring, float turn);

  int nside_;
  std::vector<Ring> rings_;  // numbered from 1, as Gorski et al. 2005 do; 0 and 4 nside stand for the poles
};

}  // namespace faceprobe::synth
