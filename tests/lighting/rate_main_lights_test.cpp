#include "faceprobe/lighting/rate_main_lights.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/microfacet.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

using testing::ellipsoid_face;

struct Scene {
  Observations face;
  Light light;
  SolveOptions options;
  std::vector<MainLight> lights;
};

// What patches show of a lamp of irradiance 1 at one point: highlights, then shading.
Eigen::VectorXd shown(const Observations& face, const Eigen::Vector3d& direction) {
  const Eigen::Index n = face.count();
  const Eigen::Vector3f towards = direction.cast<float>();
  Eigen::VectorXd rows(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3f normal = face.normal.row(i).transpose();
    const Eigen::Vector3f view = face.view.row(i).transpose();
    const Microfacet skin{.roughness = face.roughness[i], .specular_albedo = face.specular_albedo[i]};
    rows[i] = static_cast<double>(specular_lobe(normal, view, towards, skin));
    rows[n + i] = std::max(0.0, static_cast<double>(normal.dot(towards))) / kPi;
  }
  return rows;
}

Eigen::VectorXd surround(const Observations& face) {
  const SphereGrid sky(8);
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(2 * face.count());
  for (int j = 0; j < sky.cell_count(); ++j)
    rows += sky.cell_solid_angle() * shown(face, sky.direction(j).cast<double>());
  return rows;
}

MainLight lamp_of(const Eigen::Vector3d& direction, double irradiance, double solid_angle_sr) {
  MainLight lamp;
  lamp.direction = direction;
  lamp.colour.setOnes();
  lamp.irradiance = irradiance;
  lamp.solid_angle_sr = solid_angle_sr;
  return lamp;
}

// Lamps in a surround, seen by a face of `across` patches, with residuals of `residual` in both kinds of rows.
Scene scene_of(const std::vector<MainLight>& lamps, double residual, float ambient = 0.1F, int across = 20) {
  Scene scene{ellipsoid_face(across), {}, {}, lamps};
  scene.options.nside = 32;
  Eigen::VectorXd rows = static_cast<double>(ambient) * surround(scene.face);
  for (const MainLight& lamp : lamps) rows += lamp.irradiance * shown(scene.face, lamp.direction);
  const Eigen::Index n = scene.face.count();
  scene.face.highlight = rows.head(n).cast<float>().replicate(1, 3);
  scene.face.shading = rows.tail(n).cast<float>().replicate(1, 3);
  scene.light.confidence.setOnes(SphereGrid(scene.options.nside).cell_count());
  scene.light.ambient.setConstant(ambient);
  scene.light.highlight_residual = residual;
  scene.light.shading_residual = residual;
  return scene;
}

std::vector<MainLight> rated(const Scene& scene) {
  std::vector<MainLight> lights = scene.lights;
  rate_main_lights(scene.face, scene.light, scene.options, lights);
  return lights;
}

// Twenty-one patches with independent errors, as many as the formula takes for independent. The lamp and the surround that fit best, by trying
// directions a degree apart, are as far off as is stated.
TEST(RateMainLights, StatesWhatLeastSquaresIsOff) {
  constexpr double kResidual = 0.2;
  const Eigen::Vector3d truth = direction_from_angles(30, 20);
  const Scene scene = scene_of({lamp_of(truth, 1, 1e-3)}, kResidual, 0.1F, 5);
  ASSERT_EQ(scene.face.count(), 21);
  const Eigen::Index n = scene.face.count();
  const Eigen::VectorXd around = surround(scene.face);
  const Eigen::VectorXd exact = shown(scene.face, truth) + 0.1 * around;
  Eigen::VectorXd deviation(2 * n);
  deviation.head(n).setConstant(kResidual * exact.head(n).norm() / std::sqrt(static_cast<double>(n)));
  deviation.tail(n).setConstant(kResidual * exact.tail(n).norm() / std::sqrt(static_cast<double>(n)));
  const auto whitened = [&](const Eigen::VectorXd& rows) -> Eigen::VectorXd { return rows.cwiseQuotient(deviation); };
  struct Try {
    Eigen::Vector3d direction;
    Eigen::MatrixX2d columns;  // whitened: lamp, surround
  };
  std::vector<Try> tries;
  const Eigen::Vector3d u = truth.unitOrthogonal();
  const Eigen::Vector3d v = truth.cross(u);
  for (int i = -12; i <= 12; ++i) {
    for (int j = -12; j <= 12; ++j) {
      const Eigen::Vector3d aside = radians(1.0) * (i * u + j * v);
      const double angle = aside.norm();
      const Eigen::Vector3d direction =
          angle > 0 ? Eigen::Vector3d(std::cos(angle) * truth + std::sin(angle) / angle * aside) : truth;
      tries.push_back({direction, Eigen::MatrixX2d(2 * n, 2)});
      tries.back().columns << whitened(shown(scene.face, direction)), whitened(around);
    }
  }
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  constexpr int kDraws = 200;
  double angles = 0;
  double strengths = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::VectorXd data = whitened(exact) + Eigen::VectorXd::NullaryExpr(2 * n, [&] { return normal(random); });
    double least = 1e9;
    double angle = 0;
    double strength = 0;
    for (const Try& one : tries) {
      const Eigen::Vector2d fit = (one.columns.transpose() * one.columns).inverse() * (one.columns.transpose() * data);
      const double miss = (one.columns * fit - data).squaredNorm();
      if (miss >= least) continue;
      least = miss;
      angle = angle_between_deg(one.direction, truth);
      strength = fit[0] - 1;
    }
    angles += angle * angle;
    strengths += strength * strength;
  }
  const MainLight lamp = rated(scene)[0];
  // 200 draws are good to 5 %; half a cell of the grid is stated on top, and few patches bend the problem a little.
  EXPECT_NEAR(std::sqrt(angles / kDraws) / lamp.direction_uncertainty_deg.value(), 1, 0.2);
  EXPECT_NEAR(std::sqrt(strengths / kDraws) / lamp.irradiance_uncertainty.value(), 1, 0.2);
}

TEST(RateMainLights, NarrowStrongAndWellExplainedLightsAreMoreCertain) {
  const Eigen::Vector3d ahead = direction_from_angles(30, 20);
  const MainLight usual = rated(scene_of({lamp_of(ahead, 1, 0.3)}, 0.2))[0];
  const auto less = [&](const MainLight& lamp) {
    EXPECT_LT(lamp.direction_uncertainty_deg.value(), 0.97 * usual.direction_uncertainty_deg.value());
    EXPECT_LT(lamp.irradiance_uncertainty.value(), 0.97 * usual.irradiance_uncertainty.value());
  };
  less(rated(scene_of({lamp_of(ahead, 1, 0.3)}, 0.1))[0]);         // half the residual
  less(rated(scene_of({lamp_of(ahead, 1, 0.3)}, 0.2, 0.02F))[0]);  // a dimmer surround
  const MainLight narrow = rated(scene_of({lamp_of(ahead, 1, 0.02)}, 0.2))[0];
  EXPECT_LT(narrow.direction_uncertainty_deg.value(), 0.97 * usual.direction_uncertainty_deg.value());
  // A strong lamp and a weak one: the weak one is less certain than the strong one, and than alone.
  const Eigen::Vector3d other = direction_from_angles(-50, 10);
  const std::vector<MainLight> two = rated(scene_of({lamp_of(ahead, 1, 0.3), lamp_of(other, 0.3, 0.3)}, 0.2));
  const MainLight alone = rated(scene_of({lamp_of(other, 0.3, 0.3)}, 0.2))[0];
  EXPECT_GT(two[1].direction_uncertainty_deg.value(), 1.5 * two[0].direction_uncertainty_deg.value());
  EXPECT_GT(two[1].irradiance_uncertainty.value(), alone.irradiance_uncertainty.value());
}

// Errors of normals go with whole parts of a face: ten times the patches are no ten times the evidence.
TEST(RateMainLights, MorePatchesOfOneFaceSayNoMore) {
  const Eigen::Vector3d ahead = direction_from_angles(30, 20);
  const double few = rated(scene_of({lamp_of(ahead, 1, 0.3)}, 0.2, 0.1F, 12))[0].direction_uncertainty_deg.value();
  const double many = rated(scene_of({lamp_of(ahead, 1, 0.3)}, 0.2, 0.1F, 40))[0].direction_uncertainty_deg.value();
  EXPECT_NEAR(many / few, 1, 0.15);
}

TEST(RateMainLights, WhatWasNotObservedIsAsUncertainAsBefore) {
  const Eigen::Vector3d ahead = direction_from_angles(30, 20);
  Scene scene = scene_of({lamp_of(ahead, 1, 0.3)}, 0.2);
  const double seen = rated(scene)[0].direction_uncertainty_deg.value();
  scene.light.confidence.setConstant(0.3F);
  const double hardly = rated(scene)[0].direction_uncertainty_deg.value();
  EXPECT_GT(hardly, 1.5 * seen);
  scene.light.confidence.setZero();
  // The priors: one radian a way, one of the logarithm.
  EXPECT_NEAR(rated(scene)[0].direction_uncertainty_deg.value(), degrees(std::sqrt(2.0)), 0.1);
  EXPECT_NEAR(rated(scene)[0].irradiance_uncertainty.value(), 1, 1e-6);
}

// Clipped patches are lower bounds: their values say nothing of the lamp.
TEST(RateMainLights, ClippedPatchesAndAGainDoNotCount) {
  const Eigen::Vector3d ahead = direction_from_angles(30, 20);
  Scene scene = scene_of({lamp_of(ahead, 1, 0.3)}, 0.2);
  const MainLight usual = rated(scene)[0];
  scene.light.highlight_gain = 3;  // of a skin that shines more than was assumed
  scene.face.highlight *= 3;
  EXPECT_NEAR(rated(scene)[0].direction_uncertainty_deg.value(), usual.direction_uncertainty_deg.value(), 1e-3);
  scene.face.clipped.col(0).setConstant(true);
  EXPECT_FALSE(rated(scene)[0].direction_uncertainty_deg);
}

TEST(RateMainLights, WithoutResidualsNothingIsStated) {
  Scene scene = scene_of({lamp_of({0, 0, 1}, 1, 0.3)}, 0.2);
  scene.light.highlight_residual.reset();
  EXPECT_TRUE(rated(scene)[0].direction_uncertainty_deg) << "the shading is enough";
  scene.light.shading_residual.reset();
  EXPECT_FALSE(rated(scene)[0].direction_uncertainty_deg);
  scene.light.confidence.resize(3);
  EXPECT_THROW(rated(scene), std::invalid_argument);
}

// From observations with noise, through the solver: not smaller than what is off by more than chance would have it, and not a guess.
TEST(RateMainLights, TheSolversLampsAreWithinWhatIsStated) {
  const SphereGrid grid(8);
  SolveOptions options;
  options.nside = 8;
  double off = 0;
  double stated = 0;
  for (const double azimuth : {-60.0, -30.0, 0.0, 30.0, 60.0}) {
    const Eigen::Vector3d truth = direction_from_angles(azimuth, 20);
    Observations face = ellipsoid_face(20);
    testing::light_up(face, grid, testing::lamp(grid, truth, 12, 0.1F), 0.2F, 7);
    const Light light = solve(face, options);
    std::vector<MainLight> lights = main_lights(light.radiance, grid, {}, light.confidence);
    ASSERT_FALSE(lights.empty()) << azimuth;
    rate_main_lights(face, light, options, lights);
    off += std::pow(angle_between_deg(lights[0].direction, truth), 2);
    stated += std::pow(lights[0].direction_uncertainty_deg.value(), 2);
    EXPECT_LT(lights[0].direction_uncertainty_deg.value(), 30) << azimuth;
  }
  // Stated is for errors that hold together; independent ones of hundreds of patches move a lamp less.
  EXPECT_LT(std::sqrt(off / stated), 2);
}

}  // namespace
}  // namespace faceprobe::lighting
