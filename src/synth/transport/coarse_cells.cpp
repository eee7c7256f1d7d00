#include "synth/transport/coarse_cells.h"

#include <algorithm>

namespace faceprobe::synth {

CoarseCells::CoarseCells(int nside) : cells(nside % 2 == 0 ? nside / 2 : nside) {
  const SphereGrid fine(nside);
  const SphereGrid grid(nside % 2 == 0 ? nside / 2 : nside);
  children.resize(static_cast<std::size_t>(cells.count));
  for (int c = 0; c < fine.cell_count(); ++c)
    children[static_cast<std::size_t>(grid.cell_of(fine.direction(c)))].push_back(c);
  around.resize(static_cast<std::size_t>(cells.count));
  for (int c = 0; c < cells.count; ++c) {
    std::vector<int>& near = around[static_cast<std::size_t>(c)];
    const Eigen::Vector3f centre = grid.direction(c);
    for (int i = 0; i < CellSet::kParts; ++i) {
      const Eigen::Vector3f part = cells.parts.row(CellSet::kParts * c + i).transpose();
      for (const float step : {1.7F, 2.5F}) near.push_back(grid.cell_of(centre + step * (part - centre)));
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::erase(near, c);
  }
}

}  // namespace faceprobe::synth
