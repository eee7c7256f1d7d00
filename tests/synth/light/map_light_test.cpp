#include "faceprobe/synth/map_light.h"

#include "faceprobe/core/error.h"
#include "synth/light/test_maps.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

EnvMap sunny() {
  EnvMap map = sky();
  add_lamp(map, Eigen::Vector3f(1, 1, 1).normalized(), 0.6, {9000, 8000, 6000});
  return map;
}

Eigen::Vector3d energy(const Eigen::MatrixX3f& cells, const std::vector<DistantLight>& distant) {
  Eigen::Vector3d sum = cells.cast<double>().colwise().sum().transpose() * (4 * kPi / static_cast<double>(cells.rows()));
  for (const DistantLight& light : distant) sum += light.irradiance.cast<double>();
  return sum;
}

Eigen::Vector3d direction_of(const Eigen::MatrixX3f& cells, const SphereGrid& grid) {
  return (grid.directions().cast<double>().transpose() * cells.col(0).cast<double>()).normalized();
}

TEST(PrepareMap, HoldsTheMapsEnergyExactly) {
  for (const EnvMap& map : {sky(), sunny(), sky(64), sky(700)}) {
    const MapLight light = prepare_map("x", map, {});
    const Eigen::Vector3d ratio = energy(light.cells, light.distant).cwiseQuotient(map.integral());
    EXPECT_LT((ratio.array() - 1).abs().maxCoeff(), 1e-6);  // float storage
    EXPECT_LT((light.mean_radiance.cast<double>() * 4 * kPi - map.integral()).norm(), 1e-5 * map.integral().norm());
    EXPECT_EQ(light.cells.rows(), 12 * 32 * 32);
    EXPECT_EQ(light.radiance.radiance(), map.radiance());
  }
}

TEST(PrepareMap, CellsAreTheRadianceThere) {
  const EnvMap map = sky();
  const MapLight light = prepare_map("x", map, {});
  EXPECT_TRUE(light.distant.empty());
  const SphereGrid grid(32);
  // The test sky is linear in direction. At most 1 % is lost where belt and caps meet, and the four cells at each pole get a sixth
  // too much (cell_lattice_test).
  for (int cell = 4; cell < grid.cell_count() - 4; ++cell) {
    const Eigen::Vector3f seen = map.sample(grid.direction(cell));
    ASSERT_LT((light.cells.row(cell).transpose() - seen).cwiseAbs().maxCoeff(), 0.015F * seen.maxCoeff() + 2e-3F)
        << cell;
  }
}

TEST(PrepareMap, RefusesBadMapsWithASentence) {
  const auto refusal = [](const EnvMap& map) -> std::string {
    try {
      prepare_map("garden", map, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      return error.what();
    }
    return "";
  };
  const auto with = [](float value) {
    EnvMap map = sky(64);
    map.radiance()(5, 7, 1) = value;
    return map;
  };
  const std::string nan = refusal(with(std::numeric_limits<float>::quiet_NaN()));
  for (const char* part : {"garden", "NaN", "column 5", "row 7", "finite"})
    EXPECT_NE(nan.find(part), std::string::npos) << nan;
  EXPECT_NE(refusal(with(std::numeric_limits<float>::infinity())).find("infinity"), std::string::npos);
  EXPECT_NE(refusal(with(-1e-3F)).find("negative"), std::string::npos);
  EXPECT_NE(refusal(EnvMap(64, 32)).find("black"), std::string::npos);
  EXPECT_NE(refusal(EnvMap()).find("no texels"), std::string::npos);
  EXPECT_EQ(refusal(sky(64)), "");
  EXPECT_THROW(prepare_map("x", sky(64), {.max_distant = -1}), std::invalid_argument);
  EXPECT_THROW(prepare_map("x", sky(64), {.max_light_radius = 0}), std::invalid_argument);
  EXPECT_THROW(prepare_map("x", sky(64), {.nside = 0}), std::invalid_argument);
}

TEST(LightFromMap, KeepsEnergyTimesGain) {
  const EnvMap map = sunny();
  const MapLight light = prepare_map("x", map, {});
  ASSERT_EQ(light.distant.size(), 1U);
  const Eigen::Vector3f gain(0.5F, 2.0F, 3.0F);
  for (const int nside : {8, 16, 24}) {
    const LightSample sample = light_from_map(light, some_rotation(), gain, SphereGrid(nside));
    const Eigen::Vector3d expected = map.integral().cwiseProduct(gain.cast<double>());
    // Sums of 12,288 floats.
    EXPECT_LT((energy(sample.cells, sample.distant) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-5)
        << nside;
    EXPECT_GE(sample.cells.minCoeff(), 0);
    EXPECT_TRUE(sample.near.empty());
  }
}

TEST(LightFromMap, RotationInIsRotationOut) {
  EnvMap map(kTestWidth, kTestWidth / 2);
  for (float& value : map.radiance().values()) value = 1e-3F;
  const Eigen::Vector3f window = Eigen::Vector3f(-1, 0.4F, 0.8F).normalized();
  const Eigen::Vector3f sun = Eigen::Vector3f(0.2F, 0.9F, -0.5F).normalized();
  add_lamp(map, window, 10, {5, 5, 5});
  add_lamp(map, sun, 0.7, {500, 0, 0});
  const MapLight light = prepare_map("x", map, {});
  ASSERT_EQ(light.distant.size(), 1U);
  const SphereGrid grid(16);
  for (int k = 0; k < 12; ++k) {
    const Eigen::Matrix3f turn =
        some_rotation() * Eigen::AngleAxisf(0.53F * static_cast<float>(k), Eigen::Vector3f::UnitZ()).toRotationMatrix();
    const LightSample sample = light_from_map(light, turn, Eigen::Vector3f::Ones(), grid);
    EXPECT_LT((sample.distant[0].direction - turn * light.distant[0].direction).norm(), 1e-6F);
    EXPECT_EQ(sample.distant[0].irradiance, light.distant[0].irradiance);
    // A broad light's middle must not drift: a twentieth of a cell of 3.7 degrees. The even 1e-3 adds nothing to a mean direction.
    const Eigen::Vector3d expected = (turn * window).cast<double>();
    EXPECT_LT(angle_between_deg(direction_of(sample.cells, grid), expected), 0.2) << k;
    // The middle of the window, ten degrees from its edge, is as bright as it was; ripples of turned cells are under 4 %.
    EXPECT_NEAR(sample.cells(grid.cell_of(expected.cast<float>()), 1), 5.0F, 0.2F) << k;
    EXPECT_LT(sample.cells(grid.cell_of(-expected.cast<float>()), 1), 0.01F) << k;
  }
}

TEST(LightFromMap, ARedLampAtCameraRightIsAtTheRight) {
  EnvMap map(64, 32);
  map.radiance()(16, 16, 0) = 10.0F;  // u = .25: camera right
  const MapLight light = prepare_map("x", map, {});
  const LightSample sample = light_from_map(light, Eigen::Matrix3f::Identity(), Eigen::Vector3f::Ones(), SphereGrid(16));
  // One texel of 5.6 degrees is as wide as a distant light may be, or stays in the cells: either way it is at the right.
  Eigen::Vector3d mean = SphereGrid(16).cell_solid_angle() *
                         (SphereGrid(16).directions().cast<double>().transpose() * sample.cells.col(0).cast<double>());
  for (const DistantLight& d : sample.distant)
    mean += static_cast<double>(d.irradiance(0)) * d.direction.cast<double>();
  EXPECT_GT(mean.normalized().x(), 0.99);
  EXPECT_EQ(sample.cells.col(1).maxCoeff(), 0);
}

}  // namespace
}  // namespace faceprobe::synth
