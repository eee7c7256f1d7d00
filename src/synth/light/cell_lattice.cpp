#include "synth/light/cell_lattice.h"

#include "synth/light/angle_fast.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr int kBlock = 256;

struct Places {
  std::array<float, kBlock> turn;
  std::array<float, kBlock> ring;
};

// Gorski et al. 2005, Eqs. 4 and 8 and their mirror image, solved for i.
inline float ring_number(float nside, float height) {
  const float from_pole = nside * std::sqrt(3.0F * std::max(0.0F, 1.0F - std::abs(height)));
  const float cap = height > 0.0F ? from_pole : 4.0F * nside - from_pole;
  const float belt = nside * (2.0F - 1.5F * height);
  return std::abs(height) > 0.66666667F ? cap : belt;
}

void find_places(const Eigen::MatrixX3f& directions, Eigen::Index first, int count, const Eigen::Matrix3f& turn,
                 float nside, Places& places) {
  const float* dx = directions.col(0).data() + first;
  const float* dy = directions.col(1).data() + first;
  const float* dz = directions.col(2).data() + first;
  const float a = turn(0, 0), b = turn(0, 1), c = turn(0, 2);
  const float d = turn(1, 0), e = turn(1, 1), f = turn(1, 2);
  const float g = turn(2, 0), h = turn(2, 1), k = turn(2, 2);
  for (int i = 0; i < count; ++i) {
    const float x = a * dx[i] + b * dy[i] + c * dz[i];
    const float y = d * dx[i] + e * dy[i] + f * dz[i];
    const float z = g * dx[i] + h * dy[i] + k * dz[i];
    const float turns = fast_atan2(x, z) * 0.159154943F;
    places.turn[static_cast<std::size_t>(i)] = turns < 0.0F ? turns + 1.0F : turns;
    places.ring[static_cast<std::size_t>(i)] = ring_number(nside, y);
  }
}

}  // namespace

CellLattice::CellLattice(int nside) : nside_(nside), rings_(static_cast<std::size_t>(4 * nside + 1)) {
  const int cells = 12 * nside * nside;
  for (int i = 1; i < 4 * nside; ++i) {
    Ring& ring = rings_[static_cast<std::size_t>(i)];
    if (i < nside || i > 3 * nside) {
      const int k = i < nside ? i : 4 * nside - i;
      ring = {i < nside ? 2 * k * (k - 1) : cells - 2 * k * (k + 1), 4 * k, 0.5F};
    } else {
      ring = {2 * nside * (nside - 1) + (i - nside) * 4 * nside, 4 * nside, (i - nside) % 2 == 0 ? 0.5F : 0.0F};
    }
  }
}

inline CellLattice::Pair CellLattice::along(const Ring& ring, float turn) {
  const float place = turn * static_cast<float>(ring.length) - ring.shift;
  const float below = std::floor(place);
  int k = static_cast<int>(below);
  if (k < 0) k += ring.length;  // turn in [0, 1] and shift in [0, .5]: never more than one round away
  if (k >= ring.length) k -= ring.length;
  const int next = k + 1 == ring.length ? 0 : k + 1;
  return {static_cast<std::size_t>(ring.first + k), static_cast<std::size_t>(ring.first + next), place - below};
}

void CellLattice::add(const Eigen::MatrixX3f& directions, const Eigen::Matrix3f& target_from_source,
                      const Eigen::MatrixX3f& values, CellSums& sums) const {
  const auto spread = [&](const Ring& ring, float turn, const Eigen::Vector4f& value) {
    const Pair at = along(ring, turn);
    sums[at.cell] += (1.0F - at.part) * value;
    sums[at.next] += at.part * value;
  };
  const auto spread_all = [&](const Ring& ring,
                              const Eigen::Vector4f& value) {  // the pole is the mean of the four around it
    for (int k = 0; k < ring.length; ++k) sums[static_cast<std::size_t>(ring.first + k)] += 0.25F * value;
  };
  const auto south = static_cast<std::size_t>(4 * nside_);
  Places places;
  for (Eigen::Index first = 0; first < directions.rows(); first += kBlock) {
    const int count = static_cast<int>(std::min<Eigen::Index>(kBlock, directions.rows() - first));
    find_places(directions, first, count, target_from_source, static_cast<float>(nside_), places);
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Index row = first + i;
      const Eigen::Vector4f value(values(row, 0), values(row, 1), values(row, 2), 0.0F);
      const auto above = std::min(south - 1, static_cast<std::size_t>(places.ring[at]));
      const float part = std::min(1.0F, places.ring[at] - static_cast<float>(above));
      if (above == 0) {
        spread_all(rings_[1], (1.0F - part) * value);
      } else {
        spread(rings_[above], places.turn[at], (1.0F - part) * value);
      }
      if (above + 1 == south) {
        spread_all(rings_[above], part * value);
      } else {
        spread(rings_[above + 1], places.turn[at], part * value);
      }
    }
  }
}

float CellLattice::ring_at(float height) const { return ring_number(static_cast<float>(nside_), height); }

Eigen::Vector4f CellLattice::sample(const CellSums& cells, float ring, float turn) const {
  const auto value_on = [&](std::size_t number) -> Eigen::Vector4f {
    const bool pole = number == 0 || number + 1 == rings_.size();
    const Ring& r = rings_[number == 0 ? 1 : pole ? number - 1 : number];
    if (pole) {
      const auto first = static_cast<std::size_t>(r.first);
      return 0.25F * (cells[first] + cells[first + 1] + cells[first + 2] + cells[first + 3]);
    }
    const Pair at = along(r, turn);
    return (1.0F - at.part) * cells[at.cell] + at.part * cells[at.next];
  };
  const auto above = std::min(rings_.size() - 2, static_cast<std::size_t>(ring));
  const float part = std::min(1.0F, ring - static_cast<float>(above));
  return (1.0F - part) * value_on(above) + part * value_on(above + 1);
}

}  // namespace faceprobe::synth
