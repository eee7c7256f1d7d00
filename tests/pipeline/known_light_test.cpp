// The chain from layers to the light, and from a picture to the light, on a face whose light is known.

#include "faceprobe/core/angles.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/pipeline/observe.h"
#include "faceprobe/pipeline/report.h"
#include "pipeline/face_warnings.h"
#include "pipeline/light_result.h"
#include "pipeline/posed_face.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::pipeline {
namespace {

using testing::Lamp;
using testing::light_up;
using testing::LitFace;
using testing::posed_face;
using testing::PosedFace;

// Turned heads must not turn the light with them: the light is in the camera's frame.
constexpr double kHeadYaw = 25;
// In front of the camera, on the averted side (75 degrees from where the face points), and on the near side.
const std::vector<std::pair<double, double>> kLamps = {{0.0, 30.0}, {-50.0, 20.0}, {60.0, 10.0}};

ByteImage no_flags(const PosedFace& posed) {
  return {posed.geometry.region.width(), posed.geometry.region.height(), 1};
}

LightResult answer(const PosedFace& posed, const LitFace& lit) {
  const EstimateOptions options;
  const lighting::Observations seen =
      observe(posed.geometry, lit.highlight, lit.shading, no_flags(posed), options.max_patches, options.threads);
  return light_result(lighting::solve(seen, options.solve), options);
}

double error_of_strongest_deg(const LightResult& found, const Eigen::Vector3d& truth) {
  return found.lights.empty() ? 180.0 : angle_between_deg(found.lights.front().direction, truth);
}

TEST(KnownLight, TheLampThatGoesInComesOut) {
  const PosedFace posed = posed_face(kHeadYaw);
  for (const auto& [azimuth, elevation] : kLamps) {
    const Eigen::Vector3d truth = direction_from_angles(azimuth, elevation);
    // Two cells of 3.7 degrees: patches average normals, and horizons of 32 azimuths soften shadows that the truth has sharp.
    EXPECT_LE(error_of_strongest_deg(answer(posed, light_up(posed, {{truth}}, 0.05F)), truth), 8)
        << "azimuth " << azimuth << " elevation " << elevation;
  }
}

TEST(Observe, GathersTheOpenShadingAsTheShading) {
  const PosedFace posed = posed_face(kHeadYaw);
  const LitFace lit = light_up(posed, {{direction_from_angles(0.0, 30.0)}}, 0.05F);
  Image open = lit.shading;
  for (float& value : open.values()) value *= 2;
  const lighting::Observations seen = observe(posed.geometry, lit.highlight, lit.shading, no_flags(posed), 300, 1, open);
  ASSERT_EQ(seen.open_shading.rows(), seen.count());
  EXPECT_LT((seen.open_shading - 2 * seen.shading).cwiseAbs().maxCoeff(), 1e-5F);  // float sums
  EXPECT_EQ(observe(posed.geometry, lit.highlight, lit.shading, no_flags(posed), 300, 1).open_shading.rows(), 0);
  EXPECT_EQ(lighting::concatenate({seen, seen}).open_shading.rows(), 2 * seen.count());
  EXPECT_THROW(observe(posed.geometry, lit.highlight, lit.shading, no_flags(posed), 300, 1, Image(3, 3, 3)),
               std::invalid_argument);
}

TEST(KnownLight, AlsoThroughSeparatorAndAlbedo) {
  const PosedFace posed = posed_face(kHeadYaw);
  const ByteImage skin = skin_regions(posed.geometry.region);
  for (const auto& [azimuth, elevation] : kLamps) {
    const Eigen::Vector3d truth = direction_from_angles(azimuth, elevation);
    const Image photo = testing::photograph(posed, light_up(posed, {{truth}}, 0.05F));
    const highlight::Layers layers = highlight::separate(photo, skin, {.separator = highlight::Separator::kYang});
    const Image albedo = lighting::albedo_picture(
        lighting::fit_albedo(layers.diffuse, skin, no_flags(posed), posed.geometry.normal_cam), skin);
    LitFace seen{layers.highlight, layers.diffuse};
    for (std::size_t i = 0; i < albedo.values().size(); ++i) seen.shading.values()[i] /= albedo.values()[i];
    // The separator keeps part of each highlight in the diffuse layer, most where the light grazes; 15 degrees were measured on
    // the averted side. The point is that nothing in the chain mirrors or turns the light.
    EXPECT_LE(error_of_strongest_deg(answer(posed, seen), truth), 20)
        << "azimuth " << azimuth << " elevation " << elevation;
  }
}

TEST(KnownLight, RedLampAtCameraRightIsAQuarterFromTheLeftOfTheMap) {
  const PosedFace posed = posed_face(0);
  const LightResult found = answer(posed, light_up(posed, {{{1, 0, 0}, {3, 0.3F, 0.3F}}}, 0.02F));
  const Image& map = found.environment.radiance();
  Eigen::Vector2i brightest(0, 0);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map(x, y, 0) > map(brightest.x(), brightest.y(), 0)) brightest = {x, y};
    }
  }
  // 8 degrees are .022 of the width and .044 of the height.
  EXPECT_NEAR((brightest.x() + 0.5) / map.width(), 0.25, 0.022);
  EXPECT_NEAR((brightest.y() + 0.5) / map.height(), 0.5, 0.044);
  EXPECT_GT(map(brightest.x(), brightest.y(), 0), 5 * map(brightest.x(), brightest.y(), 1))
      << "it is ten times as red as green";
  EXPECT_LE(error_of_strongest_deg(found, {1, 0, 0}), 8);
  EXPECT_GT(found.lights.front().colour[0], 3 * found.lights.front().colour[2]);
  // The first band of harmonics points there too: (1, 1) goes with +x.
  EXPECT_GT(found.sh(3, 0), 3 * std::abs(found.sh(2, 0)));
}

TEST(KnownLight, EvenLightHasNoMainLight) {
  const PosedFace posed = posed_face(0);
  const LightResult found = answer(posed, light_up(posed, {}, 1.0F));
  for (const lighting::MainLight& light : found.lights) EXPECT_LT(light.share, 0.15);
  // Radiance 1 from everywhere; the truth has no shadowing of the sky, the horizons take up to a third of it in folds.
  const double mean = found.environment.integral().mean() / (4 * kPi);
  EXPECT_NEAR(mean, 1.0, 0.25);
}

TEST(KnownLight, ACompactLightIsSharpOnTheMapAndItsMainLightIsAsSmall) {
  const EstimateOptions options;
  const SphereGrid grid(options.solve.nside);
  lighting::CompactLight sun;
  sun.direction = direction_from_angles(33, 41);
  sun.irradiance = {3, 2.5, 2};
  sun.width_deg = 0.5;
  lighting::Light light;
  light.radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F) + lighting::compact_cells(sun, grid);
  light.confidence.setOnes(grid.cell_count());
  light.ambient.setConstant(0.1F);
  light.compact = sun;
  const LightResult result = light_result(light, options);
  const EnvMap& map = result.environment;
  EXPECT_TRUE(map.integral().isApprox((4 * kPi * 0.1 + sun.irradiance.array()).matrix(), 1e-3));
  // All of it is within two texels of 1.4 degrees; cells alone would spread it over ten degrees.
  double inside = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (angle_between_deg(map.direction(x, y).cast<double>(), sun.direction) < 2.8)
        inside += static_cast<double>(map.radiance()(x, y) - 0.1F) * texel_solid_angle(y, map.width(), map.height());
    }
  }
  EXPECT_NEAR(inside, 3, 0.03);
  ASSERT_EQ(result.lights.size(), 1U);
  EXPECT_NEAR(result.lights[0].solid_angle_sr, lighting::solid_angle_sr(sun), 1e-12);
  EXPECT_LT(angle_between_deg(result.lights[0].direction, sun.direction), 1e-3);
}

TEST(KnownLight, AnEmptyHighlightLayerIsNoNan) {
  const PosedFace posed = posed_face(0);
  LitFace lit = light_up(posed, {{direction_from_angles(40, 30)}}, 0.05F);
  std::ranges::fill(lit.highlight.values(), 0.0F);
  for (const lighting::Solver solver : {lighting::Solver::kTransport, lighting::Solver::kPaper}) {
    EstimateOptions options;
    options.solve.solver = solver;
    options.solve.nside = 8;
    FaceEstimate face;
    face.light_colour.setOnes();
    face.observations =
        observe(posed.geometry, lit.highlight, lit.shading, no_flags(posed), options.max_patches, options.threads);
    static_cast<LightResult&>(face) = light_result(lighting::solve(face.observations, options.solve), options);
    const bool paper = solver == lighting::Solver::kPaper;
    EXPECT_EQ(face.light.radiance.maxCoeff() > 0, !paper);
    EXPECT_TRUE(face.light.radiance.allFinite() && face.light.confidence.allFinite() && face.light.ambient.allFinite());
    EXPECT_TRUE(face.sh.allFinite() && face.sh4.allFinite());
    EXPECT_FALSE(face.light.highlight_residual);
    const std::string warning = no_highlights_warning(face, solver).value_or("");
    EXPECT_NE(warning.find(paper ? "its map is black" : "from shading alone"), std::string::npos) << warning;
    Estimate estimate;
    estimate.faces.push_back(face);
    const auto report = nlohmann::json::parse(report_json(estimate, io::Photo(), options, "face.png"));
    const auto& light = report.at("faces")[0].at("light");
    for (const char* name : {"ambient_rgb", "mean_confidence", "highlight_gain", "light_to_ambient_ratio"})
      EXPECT_EQ(light.at(name).dump().find("null"), std::string::npos) << name;
    EXPECT_EQ(light.at("spherical_harmonics").dump().find("null"), std::string::npos);
    // From black to a joint light with nothing in it.
    EXPECT_TRUE(
        lighting::solve(joint_observations({evidence_of(face), evidence_of(face)}), options.solve).radiance.allFinite());
  }
}

TEST(Observe, ClippedTransparentAndAvertedPixels) {
  const PosedFace posed = posed_face(0);
  const LitFace lit = light_up(posed, {}, 1.0F);
  ByteImage flags = no_flags(posed);
  const lighting::Observations all = observe(posed.geometry, lit.highlight, lit.shading, flags, 1500, 1);
  EXPECT_TRUE(all.validate().empty()) << all.validate();
  EXPECT_LE(all.count(), 1500);
  EXPECT_GT(all.count(), 700) << "patches are squares of whole pixels: at worst a quarter of what is allowed";
  EXPECT_GT((all.normal.array() * all.view.array()).rowwise().sum().minCoeff(), 0.1F);
  EXPECT_FALSE(all.clipped.any());
  // Red clipped in the upper half, the lower half transparent.
  for (int y = 0; y < flags.height(); ++y) {
    for (int x = 0; x < flags.width(); ++x) flags(x, y) = y < flags.height() / 2 ? io::kClippedRed : io::kTransparent;
  }
  const lighting::Observations some = observe(posed.geometry, lit.highlight, lit.shading, flags, 1500, 1);
  EXPECT_LT(some.count(), all.count());
  EXPECT_TRUE(some.clipped.col(0).all());
  EXPECT_FALSE(some.clipped.col(1).any());
}

TEST(Observe, PicturesThatDoNotFitAreRefused) {
  const PosedFace posed = posed_face(0);
  const LitFace lit = light_up(posed, {}, 1.0F);
  const ByteImage flags = no_flags(posed);
  const Image narrow(posed.geometry.region.width() - 1, posed.geometry.region.height(), 3);
  const Image grey(posed.geometry.region.width(), posed.geometry.region.height(), 1);
  EXPECT_THROW(observe(posed.geometry, narrow, lit.shading, flags, 100, 1), std::invalid_argument);
  EXPECT_THROW(observe(posed.geometry, lit.highlight, grey, flags, 100, 1), std::invalid_argument);
  EXPECT_THROW(observe(posed.geometry, lit.highlight, lit.shading, {}, 100, 1), std::invalid_argument);
  EXPECT_THROW(observe(posed.geometry, lit.highlight, lit.shading, flags, 0, 1), std::invalid_argument);
  face::FaceGeometry short_of_depth = posed.geometry;
  short_of_depth.position_cam_m = Image();
  EXPECT_THROW(observe(short_of_depth, lit.highlight, lit.shading, flags, 100, 1), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::pipeline
