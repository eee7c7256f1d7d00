#include "faceprobe/eval/sun_metrics.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

EnvMap even_map(float level = 0.2F) {
  EnvMap map(64, 32);  // texels of 5.625 degrees
  for (float& value : map.radiance().values()) value = level;
  return map;
}

void light_texel(EnvMap& map, int x, int y, float level = 50) {
  for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = level;
}

// Column 15 of 64 is left of u = .25, which is +x: azimuth 90 + 2.8125; row 7 of 32 is 90 - 7.5 * 5.625 up.
TEST(SunMetrics, OneTexelIsWhereItsAnglesSay) {
  EnvMap map = even_map();
  light_texel(map, 15, 7);
  const auto sun = sun_of(map);
  ASSERT_TRUE(sun);
  EXPECT_NEAR(azimuth_deg(sun->direction), 92.8125, 1e-4);  // directions are floats
  EXPECT_NEAR(elevation_deg(sun->direction), 47.8125, 1e-4);
  EXPECT_NEAR(sun->concentration, 1, 1e-6);
  EXPECT_NEAR(sun->solid_angle_sr, texel_solid_angle(7, 64, 32), 1e-9);
}

// The last column and the first are neighbours behind the face: their middle is straight away from the viewer, not at the centre column.
TEST(SunMetrics, ALampOnTheSeamIsOneLamp) {
  EnvMap map = even_map();
  light_texel(map, 63, 16);
  light_texel(map, 0, 16);
  const auto sun = sun_of(map);
  ASSERT_TRUE(sun);
  EXPECT_NEAR(std::abs(azimuth_deg(sun->direction)), 180, 1e-3);
  // Two unit vectors 5.625 degrees apart in azimuth, 2.8125 below the horizon: their sum rises by what it is shorter.
  const double down = radians(2.8125);
  EXPECT_NEAR(elevation_deg(sun->direction), -degrees(std::atan2(std::sin(down), std::cos(down) * std::cos(down))),
              1e-4);
}

TEST(SunMetrics, ARingAroundThePoleIsAtThePole) {
  EnvMap map = even_map();
  for (int x = 0; x < 64; ++x) light_texel(map, x, 0);
  const auto sun = sun_of(map);
  ASSERT_TRUE(sun);
  EXPECT_NEAR(elevation_deg(sun->direction), 90, 1e-3);
  EXPECT_NEAR(sun->concentration, std::sin(radians(90 - 2.8125)), 1e-5);
  const SunError error = sun_error(*sun, Sun{direction_from_angles(70, 60)});
  EXPECT_NEAR(error.angle_deg, 30, 1e-3);
  EXPECT_NEAR(error.elevation_deg, 30, 1e-3);
  EXPECT_TRUE(std::isnan(error.azimuth_deg));
}

// Two texels in rows 0 and 8 with one radiance: the upper is seen under a twentieth of the lower's solid angle and moves the middle as little.
TEST(SunMetrics, TexelsCountBySolidAngle) {
  EnvMap map = even_map();
  light_texel(map, 32, 0);
  light_texel(map, 32, 8);
  const double small = texel_solid_angle(0, 64, 32);
  const double large = texel_solid_angle(8, 64, 32);
  const Eigen::Vector3d middle =
      small * map.direction(32, 0).cast<double>() + large * map.direction(32, 8).cast<double>();
  const auto sun = sun_of(map);
  ASSERT_TRUE(sun);
  EXPECT_LT(angle_between_deg(sun->direction, middle), 1e-4);
  EXPECT_LT(elevation_deg(sun->direction), 50);  // without the solid angles it would be half-way, at 65
}

TEST(SunMetrics, TheBrightAreaIsTheSharePutIn) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f light(grid.cell_count(), 3);
  const Eigen::Vector3f towards = Eigen::Vector3f(0.4F, 0.7F, 0.6F).normalized();
  for (int j = 0; j < grid.cell_count(); ++j) light.row(j).setConstant(1 + grid.direction(j).dot(towards));
  for (const double share : {0.01, 0.1}) {
    const auto sun = sun_of(light, grid, {.share = share});
    ASSERT_TRUE(sun);
    EXPECT_NEAR(sun->solid_angle_sr / (4 * kPi), share, 2.0 / grid.cell_count());  // whole cells
    EXPECT_LT(angle_between_deg(sun->direction, towards.cast<double>()), 1);       // a quarter of a cell
  }
  // A cap of a tenth of the sphere reaches to cosine .8, on average it is at .9; brighter towards its middle.
  EXPECT_NEAR(sun_of(light, grid, {.share = 0.1})->concentration, (1.8 * 0.2 + (1 - 0.512) / 3 - 0.18) / 0.38, 0.01);
}

TEST(SunMetrics, APlateauWiderThanTheShareIsTheArea) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  const Eigen::Vector3f towards = Eigen::Vector3f(-0.5F, 0.3F, 0.8F).normalized();
  double cells = 0;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).dot(towards) < 0.8F) continue;
    light.row(j).setOnes();
    ++cells;
  }
  const auto sun = sun_of(light, grid);
  ASSERT_TRUE(sun);
  EXPECT_NEAR(sun->solid_angle_sr, cells * grid.cell_solid_angle(), 1e-9);
  EXPECT_LT(angle_between_deg(sun->direction, towards.cast<double>()), 1);
}

TEST(SunMetrics, EvenDarkAndOppositeLightHasNoSun) {
  EXPECT_FALSE(sun_of(even_map()));
  EXPECT_FALSE(sun_of(even_map(0)));
  EnvMap rounding = even_map();
  light_texel(rounding, 3, 3, 0.2000001F);
  EXPECT_FALSE(sun_of(rounding));
  const SphereGrid grid(8);
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  light.row(0).setConstant(9);
  light.row(grid.cell_of(-grid.direction(0))).setConstant(9);
  EXPECT_FALSE(sun_of(light, grid));
}

TEST(SunMetrics, AzimuthsGoTheShorterWayRound) {
  const SunError error = sun_error(Sun{direction_from_angles(170, 10)}, Sun{direction_from_angles(-160, 35)});
  EXPECT_NEAR(error.azimuth_deg, 30, 1e-9);
  EXPECT_NEAR(error.elevation_deg, 25, 1e-9);
  EXPECT_TRUE(std::isnan(sun_error(Sun{{0, 0, 1}}, std::nullopt).angle_deg));
}

TEST(SunMetrics, TheCurveCountsWhatIsWithin) {
  const std::vector<double> errors = {4, 5, 12, 29, 44, 60, kNaN, 14};
  const SunCurve curve = sun_curve(errors);
  EXPECT_EQ(curve.count, 8U);
  EXPECT_EQ(curve.missing, 1U);
  const std::array<double, 7> within = {2 / 8.0, 2 / 8.0, 4 / 8.0, 4 / 8.0, 5 / 8.0, 6 / 8.0, 7 / 8.0};
  for (std::size_t i = 0; i < within.size(); ++i) EXPECT_DOUBLE_EQ(curve.within[i], within[i]) << i;
  // Sorted: 4 5 12 14 29 44 60 180; rank .75 * 7 = 5.25.
  EXPECT_DOUBLE_EQ(curve.mark_deg, 48);
  EXPECT_LE(curve.mark_low_deg, curve.mark_deg);
  EXPECT_GE(curve.mark_high_deg, curve.mark_deg);
}

TEST(SunMetrics, TheMarksIntervalHoldsTheMarkOfMostDraws) {
  // Errors 0 .. 399: the mark's deviation is sqrt(.75 * .25 / 400) of 400, so that 95 % are within 1.96 * 8.66 = 17 of 299.
  std::vector<double> errors(400);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = static_cast<double>(i);
  const SunCurve curve = sun_curve(errors);
  EXPECT_NEAR(curve.mark_deg, 299.25, 1e-9);
  EXPECT_NEAR(curve.mark_low_deg, 299.25 - 17, 3);  // 2000 draws
  EXPECT_NEAR(curve.mark_high_deg, 299.25 + 17, 3);
}

TEST(SunMetrics, TheMarksIntervalDrawsPeople) {
  // 25 people with 16 errors each, all of a person's the same: what is known of the mark is known from 25 values.
  std::vector<double> errors;
  std::vector<double> alone;
  std::vector<std::string> persons;
  for (int i = 0; i < 400; ++i) {
    errors.push_back(i / 16);
    persons.push_back(std::to_string(i / 16));
    if (i % 16 == 0) alone.push_back(i / 16);
  }
  const SunCurve people = sun_curve(errors, {}, persons);
  const SunCurve of_alone = sun_curve(alone);
  // Between the ranks of 400 values and those of 25 there is at most one person.
  EXPECT_NEAR(people.mark_low_deg, of_alone.mark_low_deg, 1);
  EXPECT_NEAR(people.mark_high_deg, of_alone.mark_high_deg, 1);
  const SunCurve independent = sun_curve(errors);
  EXPECT_GT(people.mark_high_deg - people.mark_low_deg, 2 * (independent.mark_high_deg - independent.mark_low_deg));
  EXPECT_EQ(independent.mark_deg, people.mark_deg);
}

TEST(SunMetrics, TheTableTellsMethodsAndScenesApart) {
  ScoreTable table;
  const auto row = [&](const char* method, const char* sample, const char* scene, double off) {
    table.add({method,
               sample,
               {{"scene", scene}},
               {{"sun_centroid", off}, {"sun_azimuth", off / 2}, {"sun_elevation", off / 4}}});
  };
  row("near", "1", "outdoor", 8);
  row("near", "2", "indoor", 16);
  row("lost", "1", "outdoor", kNaN);
  table.add({"near", "3", {{"scene", "outdoor"}}, {{"other", 1}}});
  const std::string all = sun_markdown(table);
  EXPECT_NE(all.find("| near | 2 | 0 % | 50 % | 50 % | 100 % | 100 % | 100 % | 100 % | 14.0 ["), std::string::npos)
      << all;
  EXPECT_NE(all.find("| 6.0 | 3.0 |"), std::string::npos) << all;
  EXPECT_NE(all.find("| lost | 1 (1 missing) | 0 %"), std::string::npos) << all;
  const std::string outdoor = sun_markdown(table, "scene", "outdoor");
  EXPECT_NE(outdoor.find("| near | 1 | 0 % | 100 %"), std::string::npos) << outdoor;
  EXPECT_TRUE(sun_markdown(table, "scene", "nowhere").empty());
}

TEST(SunMetrics, RefusesWhatMakesNoSense) {
  EXPECT_THROW(sun_of(even_map(), {.share = 0}), std::invalid_argument);
  EXPECT_THROW(sun_of(even_map(), {.least_contrast = 1}), std::invalid_argument);
  EXPECT_THROW(sun_of(Eigen::MatrixX3f::Ones(7, 3), SphereGrid(4)), std::invalid_argument);
  EnvMap broken = even_map();
  light_texel(broken, 1, 1, std::numeric_limits<float>::quiet_NaN());
  EXPECT_THROW(sun_of(broken), std::invalid_argument);
  EXPECT_THROW(sun_curve(std::vector<double>{1, 2}, {.resamples = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::eval
