#pragma once
// The cells of a SphereGrid two by two in larger ones, for a first look at what a point sees.

#include "synth/transport/cell_set.h"

#include <vector>

namespace faceprobe::synth {

struct CoarseCells {
  // For cells of SphereGrid(nside). Half of it where that is whole; otherwise each cell is its own coarse cell.
  explicit CoarseCells(int nside);

  CellSet cells;
  std::vector<std::vector<int>> children;  // of each coarse cell
  std::vector<std::vector<int>> around;    // coarse cells that touch it, at an edge or a corner
};

}  // namespace faceprobe::synth
