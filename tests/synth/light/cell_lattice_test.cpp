#include "synth/light/cell_lattice.h"

#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "synth/light/angle_fast.h"
#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

const Eigen::Matrix3f kNoTurn = Eigen::Matrix3f::Identity();

Eigen::Vector3d first_moment(const CellSums& sums, const SphereGrid& grid) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    moment += static_cast<double>(sums[i](0)) * grid.direction(static_cast<int>(i)).cast<double>();
  }
  return moment;
}

TEST(FastAtan2, IsCloseEverywhere) {
  for (int i = 0; i < 100000; ++i) {
    const double angle = (i - 50000) * kPi / 50000.5;
    const auto y = static_cast<float>(std::sin(angle));
    const auto x = static_cast<float>(std::cos(angle));
    ASSERT_NEAR(fast_atan2(y, x), std::atan2(y, x), 1.2e-5F);  // the series' stated 1e-5 and float rounding
  }
  EXPECT_EQ(fast_atan2(0, 0), 0);
  EXPECT_NEAR(fast_atan2(0, -1), kPi, 1e-5);
}

TEST(CellLattice, ACellsOwnDirectionIsThatCell) {
  for (const int nside : {4, 16, 32}) {
    const SphereGrid grid(nside);
    const CellLattice lattice(nside);
    for (int cell = 0; cell < grid.cell_count(); ++cell) {
      CellSums sums = lattice.zero();
      lattice.add(grid.directions().row(cell), kNoTurn, Eigen::RowVector3f(1, 2, 3), sums);
      // The angle is off by 1e-5 of the cell's 6 / (4 nside), and the ring's number by the height's rounding over its slope.
      ASSERT_NEAR(sums[static_cast<std::size_t>(cell)](2), 3.0F, 3e-3F) << nside << ' ' << cell;
      if (nside == 32) cell += 36;  // not all of the 12,288
    }
  }
}

TEST(CellLattice, KeepsTheSumAndTheDirectionOfALight) {
  for (const int nside : {16, 32}) {
    const SphereGrid grid(nside);
    const CellLattice lattice(nside);
    Random random({1});
    for (int i = 0; i < 2000; ++i) {
      Eigen::Vector3f d = random.direction();
      if (i % 4 == 0)
        d = Eigen::Vector3f(0.05F * d.x(), d.y() > 0 ? 1.0F : -1.0F, 0.05F * d.z()).normalized();  // a pole
      CellSums sums = lattice.zero();
      lattice.add(d.transpose(), kNoTurn, Eigen::RowVector3f(1, 1, 1), sums);
      float total = 0;
      for (const Eigen::Vector4f& sum : sums) {
        ASSERT_GE(sum(0), -1e-6F);
        total += sum(0);
      }
      ASSERT_NEAR(total, 1.0F, 1e-5F);
      // Linear weights keep the direction up to terms of the third order on the belt. In ring k from a pole, cells are a 4 k th of
      // a turn apart, and the chord between them is nearer to the pole by 1 - cos(pi / 4 k) of k rings: .25 / k cells.
      const double off = angle_between_deg(first_moment(sums, grid), d.cast<double>());
      ASSERT_LT(off, (std::abs(d.y()) < 0.6F ? 0.02 : 0.25) * 58.6 / nside) << d.transpose();
    }
  }
}

TEST(CellLattice, EvenLightStaysEven) {
  const SphereGrid fine(64);
  const CellLattice lattice(16);
  CellSums sums = lattice.zero();
  lattice.add(fine.directions(), some_rotation(), Eigen::MatrixX3f::Ones(fine.cell_count(), 3), sums);
  for (std::size_t i = 4; i + 4 < sums.size(); ++i) {
    // 16 points to a cell. The ring where belt and cap meet has 1 / (6 nside) less than its share of places, and points of a
    // turned grid fall unevenly by a few per cent.
    ASSERT_NEAR(sums[i](0), 16.0F, 16 * 0.04F) << i;
  }
  for (const std::size_t i : {std::size_t{0}, sums.size() - 1}) {
    EXPECT_NEAR(sums[i](0), 16.0F * 7 / 6, 16 * 0.04F);  // the cells at the poles get what lies within them: a sixth more
  }
}

TEST(CellLattice, SampleInterpolatesWhatTheGridDoes) {
  const SphereGrid grid(16);
  const CellLattice lattice(16);
  CellSums cells = lattice.zero();
  for (int i = 0; i < grid.cell_count(); ++i) {
    const Eigen::Vector3f d = grid.direction(i);
    cells[static_cast<std::size_t>(i)] << d.x(), d.y(), d.z(), 1;
  }
  Random random({2});
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f d = random.direction();
    const double turn = std::atan2(static_cast<double>(d.x()), static_cast<double>(d.z())) / (2 * kPi);
    const Eigen::Vector4f value =
        lattice.sample(cells, lattice.ring_at(d.y()), static_cast<float>(turn < 0 ? turn + 1 : turn));
    EXPECT_NEAR(value(3), 1.0F, 1e-5F);
    // Chords instead of arcs: h^2 / 8 for h = 3.7 degrees is 5e-4, and in ring k from a pole (.051 k from it) cells are a 4 k th
    // of a turn apart: .051 k (1 - cos(pi / 4 k)) < .0157 / k.
    const float k = std::clamp(std::floor(16 * std::sqrt(3 * (1 - std::abs(d.y())))), 1.0F, 16.0F);
    ASSERT_LT((value.head<3>() - d).norm(), 6e-4F + 0.0157F / k) << d.transpose();
  }
}

}  // namespace
}  // namespace faceprobe::synth
