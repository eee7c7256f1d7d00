#include "faceprobe/core/sphere_grid.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

namespace faceprobe {
namespace {

TEST(SphereGrid, CentresLieInTheirOwnCells) {
  for (const int nside : {1, 2, 3, 4, 7, 16, 32}) {
    const SphereGrid grid(nside);
    for (int cell = 0; cell < grid.cell_count(); ++cell) {
      ASSERT_NEAR(grid.direction(cell).norm(), 1.0F, 1e-6F);
      ASSERT_EQ(grid.cell_of(grid.direction(cell)), cell) << "nside " << nside;
    }
  }
}

TEST(SphereGrid, CellsHaveEqualArea) {
  // 1000 points a cell on a spiral of equal areas: counts scatter less than Poisson's sqrt(1000) / 1000 = 3 %.
  const SphereGrid grid(4);
  const int count = grid.cell_count() * 1000;
  std::vector<int> hits(static_cast<std::size_t>(grid.cell_count()), 0);
  for (int i = 0; i < count; ++i) {
    const double y = 1 - (2.0 * i + 1) / count;
    const double phi = i * kPi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - y * y);
    ++hits[static_cast<std::size_t>(grid.cell_of(Eigen::Vector3d(r * std::sin(phi), y, r * std::cos(phi)).cast<float>()))];
  }
  for (const int h : hits) EXPECT_NEAR(h, 1000, 30);
}

TEST(SphereGrid, KnownCellsOfTheStandardNumbering) {
  // Gorski et al. 2005, figure 4: nside 2 ring order starts with four polar cells, then eight in ring 2, then eight.
  const SphereGrid grid(2);
  EXPECT_EQ(grid.cell_of(Eigen::Vector3f(0.1F, 1, 0.1F)), 0);
  EXPECT_NEAR(grid.direction(0).y(), 1 - 1.0 / 12, 1e-6);
  EXPECT_NEAR(grid.direction(4).y(), 2.0 / 3, 1e-6);
  EXPECT_NEAR(grid.direction(12).y(), 1.0 / 3, 1e-6);
  EXPECT_NEAR(grid.direction(47).y(), -(1 - 1.0 / 12), 1e-6);
}

TEST(SphereGrid, InterpolationIsAPartitionOfUnityAndExactAtCentres) {
  const SphereGrid grid(8);
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f d = Eigen::Vector3f(normal(random), normal(random), normal(random)).normalized();
    const SphereGrid::Interpolation at = grid.interpolate(d);
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GE(at.weight[k], -1e-5F);
      sum += at.weight[k];
      if (at.weight[k] > 1e-4F) {
        // Ring neighbours of a cell 7.3 deg across are never further than three cells away.
        EXPECT_LT(angle_between_deg(d.cast<double>(), grid.direction(at.cell[k]).cast<double>()), 22);
      }
    }
    EXPECT_NEAR(sum, 1.0F, 1e-5F);
  }
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    const SphereGrid::Interpolation at = grid.interpolate(grid.direction(cell));
    float own = 0;
    for (std::size_t k = 0; k < 4; ++k) own += at.cell[k] == cell ? at.weight[k] : 0.0F;
    EXPECT_NEAR(own, 1.0F, 1e-3F) << cell;
  }
}

TEST(SphereGrid, MapsThereAndBackKeepEnergyAndPlace) {
  EnvMap map(256, 128);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      map.radiance()(x, y, 0) = 1.0F;
      const double angle = angle_between_deg(map.direction(x, y).cast<double>(), {1, 0.2, 0.4});
      map.radiance()(x, y, 1) = angle < 10 ? 50.0F : 0.0F;
    }
  }
  const SphereGrid grid(16);
  const Eigen::MatrixX3f cells = grid_from_env_map(map, grid);
  const Eigen::Vector3d energy = cells.cast<double>().colwise().sum().transpose() * grid.cell_solid_angle();
  EXPECT_NEAR(energy[0] / (4 * kPi), 1.0, 1e-5);  // float storage of 3072 cells
  EXPECT_NEAR(energy[1] / map.integral()[1], 1.0, 1e-5);
  // A constant map gives constant cells up to how the texels of 1.4 deg fall into cells of 3.7 deg.
  EXPECT_GT(cells.col(0).minCoeff(), 0.85F);
  EXPECT_LT(cells.col(0).maxCoeff(), 1.15F);

  const EnvMap back = env_map_from_grid(cells, grid, 256, 128);
  EXPECT_NEAR(back.integral()[1] / map.integral()[1], 1.0, 1e-5);
  Eigen::Index brightest = 0;
  cells.col(1).maxCoeff(&brightest);
  EXPECT_LT(angle_between_deg(grid.direction(static_cast<int>(brightest)).cast<double>(), {1, 0.2, 0.4}), 10);
}

TEST(SphereGrid, AMapWithoutARowForEveryCellIsRefused) {
  const SphereGrid grid(4);
  EXPECT_THROW(env_map_from_grid(Eigen::MatrixX3f::Ones(grid.cell_count() - 1, 3), grid, 16, 8), std::invalid_argument);
  EXPECT_THROW(env_map_from_grid(Eigen::MatrixX3f::Ones(grid.cell_count(), 3), grid, 0, 8), std::invalid_argument);
}

TEST(SphereGrid, SmallMapsDoNotMissSmallLamps) {
  const SphereGrid grid(16);
  for (int cell = 0; cell < grid.cell_count(); cell += 97) {
    Eigen::MatrixX3f cells = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 1.0F);
    cells(cell, 0) = 1000.0F;
    const EnvMap map = env_map_from_grid(cells, grid, 16, 8);
    const double truth = cells.col(0).cast<double>().sum() * grid.cell_solid_angle();
    EXPECT_NEAR(map.integral()[0] / truth, 1.0, 1e-3);
    // The lamp's energy lies around the lamp and is not spread over the sky.
    EXPECT_LT(map.sample(-grid.direction(cell))[0], 1.5F);
  }
}

TEST(SphereGrid, LightMovesToAnotherGridWhereItWas) {
  const SphereGrid coarse(4);
  const SphereGrid fine(16);
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Ones(coarse.cell_count(), 3);
  EXPECT_LT((grid_from_grid(light, coarse, fine).array() - 1).abs().maxCoeff(), 1e-5F);
  for (const int cell : {0, 50, 100, 191}) {
    Eigen::MatrixX3f lamp = Eigen::MatrixX3f::Zero(coarse.cell_count(), 3);
    lamp(cell, 1) = 10;
    const Eigen::MatrixX3f seen = grid_from_grid(lamp, coarse, fine);
    Eigen::Index brightest = 0;
    seen.col(1).maxCoeff(&brightest);
    EXPECT_GT(fine.direction(static_cast<int>(brightest)).dot(coarse.direction(cell)), std::cos(0.08));  // a fine cell
    // Weights are of equal-area cells, so the energy stays to a few percent.
    EXPECT_NEAR(seen.col(1).sum() / 16, 10, 0.6);
    EXPECT_TRUE(seen.col(0).isZero());
  }
  EXPECT_THROW(grid_from_grid(light, fine, coarse), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe
