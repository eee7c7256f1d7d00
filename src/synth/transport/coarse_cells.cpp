#include "synth/transport/coarse_cells.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {

CoarseCells::CoarseCells(int nside) : cells(nside % 2 == 0 ? nside / 2 : nside) {
  const SphereGrid fine(nside);
  const SphereGrid grid(nside % 2 == 0 ? nside / 2 : nside);
  children.resize(static_cast<std::size_t>(cells.count));
  for (int c = 0; c < fine.cell_count(); ++c)
    children[static_cast<std::size_t>(grid.cell_of(fine.direction(c)))].push_back(c);
  // Eight places around a cell, where its neighbours' middles are in the plane's chequerboard.
  constexpr int kPlaces = 8;
  const float side = std::sqrt(static_cast<float>(grid.cell_solid_angle()));
  around.resize(static_cast<std::size_t>(cells.count));
  for (int c = 0; c < cells.count; ++c) {
    std::vector<int>& near = around[static_cast<std::size_t>(c)];
    for (const int other : cells.neighbour[static_cast<std::size_t>(c)]) near.push_back(other);
    const Eigen::Vector3f centre = grid.direction(c);
    const Eigen::Vector3f u = centre.unitOrthogonal();
    const Eigen::Vector3f v = centre.cross(u);
    for (int k = 0; k < kPlaces; ++k) {
      const float angle = 2.0F * 3.14159265F * static_cast<float>(k) / kPlaces;
      near.push_back(grid.cell_of((centre + 1.2F * side * (std::cos(angle) * u + std::sin(angle) * v)).normalized()));
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::erase(near, c);
  }
}

}  // namespace faceprobe::synth
