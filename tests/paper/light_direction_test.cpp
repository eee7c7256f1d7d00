// Directions of lights that are known.
#include "paper/light_direction.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::cli::testing {
namespace {

const Eigen::Vector3d kLamp = Eigen::Vector3d(0.4, 0.5, 0.6).normalized();

// Ambient light of 1 and a lamp that falls off as a cosine to the 40th.
pipeline::LightResult lamp_and_ambient(double strength) {
  const SphereGrid grid(8);
  pipeline::LightResult result;
  result.light.radiance.resize(grid.cell_count(), 3);
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    const double cosine = grid.direction(cell).cast<double>().dot(kLamp);
    result.light.radiance.row(cell).setConstant(static_cast<float>(1 + strength * std::pow(std::max(0.0, cosine), 40)));
  }
  return result;
}

TEST(LightDirections, TheBrightestCellStandsInForAMainLight) {
  pipeline::LightResult result = lamp_and_ambient(5);
  const std::vector<Eigen::Vector3d> brightest = light_directions(result);
  ASSERT_EQ(brightest.size(), 1U);
  EXPECT_LT(angle_between_deg(brightest[0], kLamp), degrees(SphereGrid(8).cell_radius()) * 1.5);  // cells are no discs
  result.lights.push_back({.direction = Eigen::Vector3d::UnitX(), .colour = Eigen::Vector3d::Ones()});
  EXPECT_EQ(light_directions(result), std::vector<Eigen::Vector3d>{Eigen::Vector3d::UnitX()});
}

TEST(ResultOf, HasTheMainLightsOfWhatIsCertain) {
  const Eigen::MatrixX3f radiance = lamp_and_ambient(5).light.radiance;
  const pipeline::LightResult result = result_of(radiance);
  ASSERT_EQ(result.lights.size(), 1U);
  // The lobe is even around the lamp.
  EXPECT_LT(angle_between_deg(light_directions(result)[0], kLamp), degrees(SphereGrid(8).cell_radius()));
  EXPECT_TRUE(result_of(radiance, Eigen::VectorXf::Zero(radiance.rows())).lights.empty());
}

TEST(LightDirections, AnEvenSkyHasNone) {
  EXPECT_TRUE(light_directions(lamp_and_ambient(0)).empty());
  EXPECT_FALSE(energy_centroid(lamp_and_ambient(0)));
}

TEST(EnergyCentroid, IsTheLampWhateverTheAmbientLight) {
  const std::optional<Eigen::Vector3d> centroid = energy_centroid(lamp_and_ambient(5));
  ASSERT_TRUE(centroid);
  // The lobe is even around the lamp; it is 33 cells wide at half its height.
  EXPECT_LT(angle_between_deg(*centroid, kLamp), 1);
}

TEST(SingleLamp, ComesBackFromItsOwnShading) {
  lighting::Observations observations;
  observations.resize(400);
  Random random({3});
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    // Within 60 degrees of the lamp: the fit knows of no shadow.
    const Eigen::Vector3d aside(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    const Eigen::Vector3d normal = (kLamp + aside).normalized();
    observations.normal.row(i) = normal.transpose().cast<float>();
    observations.shading.row(i).setConstant(static_cast<float>(normal.dot(kLamp)));
  }
  observations.clipped.row(0).setConstant(true);
  observations.shading.row(0).setConstant(1e4F);  // left out, or it would turn the lamp
  const std::optional<Eigen::Vector3d> lamp = single_lamp(observations);
  ASSERT_TRUE(lamp);
  EXPECT_LT(angle_between_deg(*lamp, kLamp), 0.01);  // shading is exact but for float
}

TEST(MeanDirection, OppositeOnesCancel) {
  EXPECT_FALSE(mean_direction({}));
  EXPECT_FALSE(mean_direction({Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitX()}));
  const std::optional<Eigen::Vector3d> between = mean_direction({Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()});
  ASSERT_TRUE(between);
  EXPECT_NEAR(angle_between_deg(*between, Eigen::Vector3d::UnitX()), 45, 1e-9);
}

TEST(NearestDeg, TakesTheNearest) {
  EXPECT_NEAR(nearest_deg(Eigen::Vector3d::UnitX(), {-Eigen::Vector3d::UnitX(), Eigen::Vector3d(1, 1, 0)}), 45, 1e-9);
}

TEST(AgreementWithOthers, IsTheCorrelationWithEverybodyElse) {
  Eigen::MatrixXd maps(4, 4);
  maps.col(0) << 1, 2, 3, 4;
  maps.col(1) << -5, 5, -5, 5;  // the same person: not asked
  maps.col(2) << 20, 40, 60, 80;
  maps.col(3) << 4, 3, 2, 1;
  const std::vector<double> agreement = agreement_with_others(maps, {0, 0, 1, 2});
  ASSERT_EQ(agreement.size(), 4U);
  EXPECT_NEAR(agreement[0], 0, 1e-12);                                 // 1 with the third, -1 with the fourth
  EXPECT_NEAR(agreement[2], (1 + 1 / std::sqrt(5.0) - 1) / 3, 1e-12);  // 1 / sqrt(5) with the second
}

TEST(AgreementWithOthers, IsNothingForOnePersonAndForEvenMaps) {
  Eigen::MatrixXd maps(3, 3);
  maps.col(0) << 1, 2, 3;
  maps.col(1) << 2, 2, 2;
  maps.col(2) << 3, 5, 7;
  const std::vector<double> agreement = agreement_with_others(maps, {0, 1, 2});
  EXPECT_NEAR(agreement[0], 1, 1e-12);  // the even map is left out
  EXPECT_TRUE(std::isnan(agreement[1]));
  EXPECT_TRUE(std::isnan(agreement_with_others(maps, {7, 7, 7})[0]));
}

}  // namespace
}  // namespace faceprobe::cli::testing
