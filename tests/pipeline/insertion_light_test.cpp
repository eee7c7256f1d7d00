#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/pipeline/insertion.h"
#include "pipeline/placed_things.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace faceprobe::pipeline {
namespace {

using faceprobe::testing::expect_error;
using testing::even_map;
using testing::face_at;
using testing::kDepthM;
using testing::marker;
using testing::only_face;
using testing::photo_of;
using testing::pixel_of;

double luminance_of(const Eigen::Vector3d& rgb) { return rgb.dot(luminance_weights<double>()); }

struct Patch {
  Eigen::Vector3d towards;
  double irradiance;
  Eigen::Vector3d colour{1.6, 0.9, 0.6};  // reddish
};

// The map of patches of 8 degrees and an even surround.
void shine(LightResult& result, const std::vector<Patch>& patches) {
  const SphereGrid grid(16);
  result.light.radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  for (const Patch& patch : patches) {
    std::vector<int> cells;
    for (int j = 0; j < grid.cell_count(); ++j) {
      if (grid.direction(j).cast<double>().dot(patch.towards.normalized()) > std::cos(radians(8.0))) cells.push_back(j);
    }
    const double sum = static_cast<double>(cells.size()) * grid.cell_solid_angle() * luminance_of(patch.colour);
    for (const int j : cells)
      result.light.radiance.row(j) += (patch.irradiance / sum * patch.colour).transpose().cast<float>();
  }
  result.light.confidence = Eigen::VectorXf::Ones(grid.cell_count());
  result.environment = env_map_from_grid(result.light.radiance, grid, 128, 64);
  result.lights = lighting::main_lights(result.light.radiance, grid, {}, result.light.confidence);
}

void light_face(FaceEstimate& face, const Eigen::Vector3d& towards, double irradiance) {
  shine(face, {{.towards = towards, .irradiance = irradiance}});
}

Estimate under_one_lamp(const Eigen::Vector3d& lamp_m) {
  Estimate estimate = only_face(100);
  estimate.faces = {face_at({-0.6, 0, -2}, 80, 60), face_at({0.7, 0.1, -2.2}, 500, 55)};
  double intensity = 6;
  for (FaceEstimate& face : estimate.faces) {
    const Eigen::Vector3d way = lamp_m - face.face.position_m();
    light_face(face, way, intensity / way.squaredNorm());
    intensity *= 1.3;  // the second skin is darker than it is taken to be
  }
  return estimate;
}

TEST(Insertion, TheLightIsWhoseItIsToldToBe) {
  Estimate estimate = only_face(60);
  estimate.faces.push_back(face_at({0.5, 0, -kDepthM}, 400, 120));
  estimate.faces[0].environment = even_map(1);
  estimate.faces[1].environment = even_map(2);
  estimate.joint.emplace();
  estimate.joint->environment = even_map(3);
  const auto level = [&](const InsertionOptions& options) {
    return scene_for(photo_of(estimate), estimate, marker(), options).environment.radiance()(0, 0, 0);
  };
  EXPECT_EQ(level({.face = 0}), 1.0F);
  EXPECT_EQ(level({.face = 1}), 2.0F);
  EXPECT_EQ(level({.face = 1, .joint_light = true}), 3.0F);
  expect_error(ExitCode::kUsage, {"0 to 1"}, [&] { level({.face = 2}); });
}

TEST(Insertion, ANearLampIsPutWhereItStandsAndTakenOutOfTheMap) {
  const Eigen::Vector3d lamp_m(0.2, 0.9, -0.9);
  const Estimate estimate = under_one_lamp(lamp_m);
  for (const std::size_t i : {0U, 1U}) {
    const FaceEstimate& face = estimate.faces[i];
    const Eigen::Vector3f foot = face.face.position_m().cast<float>() - Eigen::Vector3f(0, 0.3F, 0);
    const insert::Scene scene =
        scene_for(photo_of(estimate), estimate, marker(),
                  {.at_px = pixel_of(view_of(estimate), foot), .depth_m = -foot.z(), .height_m = 0.2F});
    ASSERT_EQ(face.lights.size(), 1U);
    ASSERT_EQ(scene.lamps.size(), 1U);
    const render::BallLamp& lamp = scene.lamps[0];
    // The patch's centroid is found to about a degree, as cells are 3.7 degrees wide; rays 1.5 m long meet at a slant.
    EXPECT_LT((lamp.position_m.cast<double>() - lamp_m).norm(), 0.08);
    EXPECT_GT(lamp.radius_m, 0);
    const double distance = (lamp.position_m.cast<double>() - face.face.position_m()).norm();
    const Eigen::Vector3d by_lamp = lamp.intensity.cast<double>() / (distance * distance);
    const Eigen::Vector3d rest = scene.environment.integral();
    const Eigen::Vector3d whole = face.environment.integral();
    EXPECT_LT(luminance_of(rest), 0.5 * luminance_of(whole));  // the lamp was most of it
    // Of either face: each is lit by the map that is its own.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(by_lamp[c] + rest[c], whole[c], 0.01 * whole[c]) << i << ' ' << c;
    // What is left is as bright as the surround; interpolated, then scaled to keep each channel's sum.
    const Image& map = scene.environment.radiance();
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x)
        ASSERT_NEAR(luminance_of(Eigen::Map<const Eigen::Vector3f>(map.pixel(x, y)).cast<double>()), 0.1, 0.005)
            << x << ' ' << y;
    }
  }
}

// A lamp that is weaker than a bluish sun; each face's map, and one of both.
const Eigen::Vector3d kLampBehindSun(0.2, 0.9, -0.9);
Estimate under_sun_and_lamp() {
  const Patch sun{.towards = {-0.9, 0.3, 0.3}, .irradiance = 4, .colour = {0.6, 1, 1.5}};
  Estimate estimate = under_one_lamp(kLampBehindSun);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (FaceEstimate& face : estimate.faces) {
    const lighting::MainLight lamp = face.lights.at(0);
    shine(face, {sun, {.towards = kLampBehindSun - face.face.position_m(), .irradiance = lamp.irradiance}});
    middle += 0.5 * face.face.position_m();
  }
  estimate.joint.emplace();
  shine(*estimate.joint, {sun, {.towards = kLampBehindSun - middle, .irradiance = 2.5}});
  return estimate;
}

// The lamp is in the scene and the sun in the map, and together they are the whole light. `per_intensity`: irradiance of a lamp there.
template <class PerIntensity>
void expect_lamp_apart(const insert::Scene& scene, const LightResult& light, const PerIntensity& per_intensity) {
  ASSERT_EQ(light.lights.size(), 2U);
  ASSERT_LT(light.lights[0].direction.x(), -0.8);  // the sun comes first
  ASSERT_EQ(scene.lamps.size(), 1U);
  const Eigen::Vector3d place = scene.lamps[0].position_m.cast<double>();
  EXPECT_LT((place - kLampBehindSun).norm(), 0.08);  // as for one lamp alone
  const Eigen::Vector3d by_lamp = per_intensity(place) * scene.lamps[0].intensity.cast<double>();
  const Eigen::Vector3d rest = scene.environment.integral();
  const Eigen::Vector3d whole = light.environment.integral();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(by_lamp[c] + rest[c], whole[c], 0.01 * whole[c]) << c;
  EXPECT_NEAR(luminance_of(by_lamp), light.lights[1].irradiance, 1e-3 * light.lights[1].irradiance);
  EXPECT_NEAR(luminance_of(rest), 0.1 * 4 * kPi + 4, 0.05);  // 1 %, of the map's texels
}

TEST(Insertion, ANearLampIsFoundBehindAStrongerLight) {
  const Estimate estimate = under_sun_and_lamp();
  for (const int i : {0, 1}) {
    const FaceEstimate& face = estimate.faces[static_cast<std::size_t>(i)];
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), {.face = i});
    expect_lamp_apart(scene, face,
                      [&](const Eigen::Vector3d& place) { return 1 / (place - face.face.position_m()).squaredNorm(); });
  }
}

TEST(Insertion, ANearLampLeavesTheJointLightToo) {
  const Estimate estimate = under_sun_and_lamp();
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), {.joint_light = true});
  expect_lamp_apart(scene, *estimate.joint, [&](const Eigen::Vector3d& place) {  // as the faces have it on average
    double sum = 0;
    for (const FaceEstimate& face : estimate.faces) sum += 1 / (place - face.face.position_m()).squaredNorm();
    return sum / 2;
  });
  // One that the joint light does not show stays out of the scene.
  Estimate dark = under_sun_and_lamp();
  shine(*dark.joint, {{.towards = {-0.9, 0.3, 0.3}, .irradiance = 4}});
  const insert::Scene without = scene_for(photo_of(dark), dark, marker(), {.joint_light = true});
  EXPECT_TRUE(without.lamps.empty());
  EXPECT_EQ(without.environment.radiance(), dark.joint->environment.radiance());
}

TEST(Insertion, LightsWithoutAPlaceStayInTheMap) {
  Estimate estimate = under_one_lamp({0.2, 0.9, -0.9});
  const auto plain = [&] {
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker());
    const bool known = scene.environment.radiance() == estimate.faces[0].environment.radiance() ||
                       scene.environment.radiance() == estimate.faces[1].environment.radiance();
    return scene.lamps.empty() && known;
  };
  EXPECT_FALSE(plain());
  for (FaceEstimate& face : estimate.faces) light_face(face, {0.5, 0.7, 0.4}, 3);  // the sun
  EXPECT_TRUE(plain());
  light_face(estimate.faces[0], {-0.9, 0.1, 0.3}, 3);  // lights that do not meet
  light_face(estimate.faces[1], {0.9, 0.1, 0.3}, 3);
  EXPECT_TRUE(plain());
  for (FaceEstimate& face : estimate.faces) face.lights.clear();
  EXPECT_TRUE(plain());
}

}  // namespace
}  // namespace faceprobe::pipeline
