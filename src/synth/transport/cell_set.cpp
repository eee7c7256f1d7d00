#include "synth/transport/cell_set.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace faceprobe::synth {
namespace {

// Centres of the cells of a grid `factor` times finer, those of one coarse cell together: the cells of HEALPix nest.
Eigen::MatrixX3f children(const SphereGrid& grid, int factor) {
  const SphereGrid fine(grid.nside() * factor);
  const int per_cell = factor * factor;
  Eigen::MatrixX3f out(fine.cell_count(), 3);
  std::vector<int> filled(static_cast<std::size_t>(grid.cell_count()), 0);
  for (int c = 0; c < fine.cell_count(); ++c) {
    const int parent = grid.cell_of(fine.direction(c));
    int& count = filled[static_cast<std::size_t>(parent)];
    assert(count < per_cell);
    out.row(per_cell * parent + count++) = fine.directions().row(c);
  }
  return out;
}

// The four cells next to a cell, found by stepping over its edge through each of its fine parts.
std::array<int, 4> neighbours(const SphereGrid& grid, const CellSet& cells, int cell) {
  const Eigen::Vector3f centre = grid.direction(cell);
  std::vector<int> found;
  for (int i = 0; i < CellSet::kParts; ++i) {
    const Eigen::Vector3f part = cells.parts.row(CellSet::kParts * cell + i).transpose();
    const int other = grid.cell_of(centre + 2.5F * (part - centre));
    if (other != cell && std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
  }
  std::sort(found.begin(), found.end(), [&](int a, int b) {
    const float to_a = grid.direction(a).dot(centre);
    const float to_b = grid.direction(b).dot(centre);
    return to_a != to_b ? to_a > to_b : a < b;
  });
  std::array<int, 4> out;
  out.fill(cell);
  std::copy_n(found.begin(), std::min(found.size(), out.size()), out.begin());
  return out;
}

}  // namespace

CellSet::CellSet(int nside) {
  const SphereGrid grid(nside);
  count = grid.cell_count();
  solid_angle = static_cast<float>(grid.cell_solid_angle());
  centre = grid.directions();
  quarters = children(grid, 2);
  parts = children(grid, 4);
  mean.resize(count, 3);
  float cosine = 1;
  for (int c = 0; c < count; ++c) {
    const auto own = parts.middleRows(kParts * c, kParts);
    mean.row(c) = own.colwise().mean();
    cosine = std::min(cosine, (own * centre.row(c).transpose()).minCoeff());
  }
  reach = std::acos(cosine) / 0.75F;  // the outermost parts' centres are three quarters of the way to the corners
  neighbour.reserve(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) neighbour.push_back(neighbours(grid, *this, c));

  const SphereGrid coarse(std::max(1, nside / 4));
  std::vector<int> parent(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) parent[static_cast<std::size_t>(c)] = coarse.cell_of(grid.direction(c));
  order.resize(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return parent[static_cast<std::size_t>(a)] < parent[static_cast<std::size_t>(b)];
  });
}

void CellSet::cosine_weights(const Eigen::Vector3f& normal, Eigen::ArrayXf& out) const {
  out = (centre * normal).array();
  const float edge = std::sin(reach);
  for (int c = 0; c < count; ++c) {
    if (out(c) <= -edge) {
      out(c) = 0;
    } else if (out(c) < edge) {  // the horizon goes through it
      out(c) = (parts.middleRows<kParts>(kParts * c) * normal).array().max(0.0F).mean();
    } else {
      out(c) = mean.row(c).dot(normal);
    }
  }
  out /= out.sum();
}

}  // namespace faceprobe::synth
