#include "eval/small_faces.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/geometry_benchmark.h"
#include "faceprobe/eval/shading_benchmark.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace faceprobe::eval {
namespace {

// The known normals turned about an axis at right angles to each of them: off by that angle everywhere.
GeometryMethod off_by(const SmallFaces& faces, const std::string& name, double angle_deg, double stated_deg) {
  GeometryEstimate estimate{faces.view.normal, Image(SmallFaces::kSize, SmallFaces::kSize, 1), faces.view.region};
  for (std::size_t i = 0; i < estimate.normal_cam.pixel_count(); ++i) {
    Eigen::Map<Eigen::Vector3f> normal(estimate.normal_cam.data() + 3 * i);
    estimate.normal_error_rad.data()[i] = static_cast<float>(radians(stated_deg));
    if (normal.isZero()) continue;
    const Eigen::Vector3f axis = normal.unitOrthogonal();
    normal = Eigen::AngleAxisf(static_cast<float>(radians(angle_deg)), axis) * Eigen::Vector3f(normal);
  }
  return {name, [estimate](const PhotoInput&) { return estimate; }};
}

TEST(GeometryBenchmark, ThirdsAreMeansOverAThirdOfThePixels) {
  EXPECT_DOUBLE_EQ(thirds_of({{0, 1}, {0, 5}, {0, 3}}).best_deg, 1);
  EXPECT_DOUBLE_EQ(thirds_of({{0, 1}, {0, 5}, {0, 3}}).worst_deg, 3);
  std::vector<CalibrationBin> tenths;
  for (int i = 0; i < 10; ++i) tenths.push_back({0, static_cast<double>(i)});
  EXPECT_NEAR(thirds_of(tenths).best_deg, (0 + 1 + 2 + 3 / 3.0) / (10 / 3.0), 1e-12);
  EXPECT_NEAR(thirds_of(tenths).worst_deg, (9 + 8 + 7 + 6 / 3.0) / (10 / 3.0), 1e-12);
  EXPECT_TRUE(std::isnan(thirds_of({}).best_deg));
}

TEST(GeometryBenchmark, MeasuresTheAngleTheStatedErrorAndTheRegions) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const std::vector<GeometryMethod> methods = {off_by(small, "right", 0, 1), off_by(small, "off", 10, 20)};
  const GeometryScores scores = measure_geometry(faces, methods, {.samples = 3});
  EXPECT_NEAR(scores.table.summary("normal", {.method = "right"}).mean, 0, 0.1);  // stored in half precision
  EXPECT_NEAR(scores.table.summary("normal", {.method = "off"}).mean, 10, 0.1);
  EXPECT_NEAR(scores.table.summary("normal_median", {.method = "off"}).mean, 10, 0.1);
  EXPECT_NEAR(scores.table.summary("normal_cheeks", {.method = "off"}).mean, 10, 0.1);
  const CalibrationBin bin = scores.calibration.at("off").front();
  EXPECT_NEAR(bin.stated_deg, 20, 0.1);
  EXPECT_NEAR(bin.true_deg, 10, 0.1);
  EXPECT_NEAR(scores.mean_overlap("right"), 1, 1e-12);
  EXPECT_NEAR(scores.skin_overlap.at("right"), 1, 1e-12);
}

TEST(GeometryBenchmark, AMethodWithoutAFaceIsMissingAndHarmsNoOther) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const std::vector<GeometryMethod> methods = {{"blind", [](const PhotoInput&) { return GeometryEstimate{}; }},
                                               off_by(small, "right", 0, 1)};
  const GeometryScores scores = measure_geometry(faces, methods, {.samples = 3});
  EXPECT_EQ(scores.table.summary("normal", {.method = "blind"}).missing, 3U);
  EXPECT_EQ(scores.table.summary("normal", {.method = "right"}).count, 3U);
  EXPECT_FALSE(scores.region_overlap.contains("blind"));
  EXPECT_EQ(scores.without_face.at("blind"), 3);
  EXPECT_EQ(scores.without_face.at("right"), 0);
}

// A method that finds the face in some photos alone is judged by these, and the rest is told.
TEST(GeometryBenchmark, OverlapsTellHowManyPhotosTheyLeaveOut) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const GeometryMethod right = off_by(small, "right", 0, 1);
  int asked = 0;
  const GeometryMethod first = {
      "first", [&](const PhotoInput& input) { return ++asked == 1 ? right.find(input) : GeometryEstimate{}; }};
  const GeometryScores scores = measure_geometry(faces, {first}, {.samples = 3});
  EXPECT_NEAR(scores.mean_overlap("first"), 1, 1e-12);
  EXPECT_EQ(scores.without_face.at("first"), 2);
}

// Half of one region named as the other: of the named one's pixels half again too many, of the other's half left.
TEST(GeometryBenchmark, OverlapIsIntersectionOverUnion) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  GeometryEstimate estimate{small.view.normal, {}, small.view.region};
  double forehead = 0, cheeks = 0, taken = 0;
  for (int y = 0; y < SmallFaces::kSize; ++y) {
    for (int x = 0; x < SmallFaces::kSize; ++x) {
      std::uint8_t& region = estimate.region(x, y);
      forehead += region == static_cast<std::uint8_t>(Region::kForehead) ? 1 : 0;
      if (region != static_cast<std::uint8_t>(Region::kCheeks)) continue;
      ++cheeks;
      if (x % 2 != 0) continue;
      region = static_cast<std::uint8_t>(Region::kForehead);
      ++taken;
    }
  }
  const std::vector<GeometryMethod> methods = {{"half", [&](const PhotoInput&) { return estimate; }}};
  const GeometryScores scores = measure_geometry(faces, methods, {.samples = 3});
  const auto& overlap = scores.region_overlap.at("half");
  EXPECT_NEAR(overlap[static_cast<std::size_t>(Region::kForehead)], forehead / (forehead + taken), 1e-12);
  EXPECT_NEAR(overlap[static_cast<std::size_t>(Region::kCheeks)], (cheeks - taken) / cheeks, 1e-12);
  EXPECT_NEAR(scores.skin_overlap.at("half"), 1, 1e-12);
}

TEST(ShadingBenchmark, AScaleDoesNotMatterAndAColourDoes) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const auto scaled = [&](float red) {
    ShadingEstimate estimate{small.truth.albedo, small.truth.shading};
    for (std::size_t i = 0; i < estimate.shading.values().size(); ++i) {
      estimate.albedo.data()[i] *= 0.5F;
      estimate.shading.data()[i] *= i % 3 == 0 ? 3 * red : 3.0F;
    }
    return [estimate](const PhotoInput&) { return estimate; };
  };
  const ScoreTable table = measure_shading(faces, {{"scaled", scaled(1)}, {"red", scaled(1.5F)}}, {.samples = 3});
  // The data are stored as half floats: a two-thousandth each, a hundredth where dark ones are divided.
  EXPECT_NEAR(table.summary("albedo", {.method = "scaled"}).mean, 0, 0.01);
  EXPECT_NEAR(table.summary("shading", {.method = "scaled"}).mean, 0, 0.01);
  EXPECT_NEAR(table.summary("light_colour", {.method = "scaled"}).mean, 0, 0.1);
  // Between (1, 1.1, 1.2) and (1.5, 1.1, 1.2).
  const Eigen::Vector3d a(1, 1.1, 1.2), b(1.5, 1.1, 1.2);
  EXPECT_NEAR(table.summary("light_colour", {.method = "red"}).mean, degrees(std::acos(a.dot(b) / a.norm() / b.norm())),
              0.1);
}

TEST(ShadingBenchmark, TheErrorIsTheSineOfTheAngleBetweenThePictures) {
  Image a(2, 1, 3), b(2, 1, 3);
  a(0, 0, 0) = 1;
  b(0, 0, 0) = 3;
  b(1, 0, 0) = 4;
  EXPECT_NEAR(scale_invariant_error(a, b, ByteImage(2, 1, 1, 1)), 0.8, 1e-6);
  EXPECT_NEAR(scale_invariant_error(b, b, ByteImage(2, 1, 1, 1)), 0, 1e-6);
  EXPECT_NEAR(scale_invariant_error(Image(2, 1, 3), b, ByteImage(2, 1, 1, 1)), 1, 1e-6);
  EXPECT_TRUE(std::isnan(scale_invariant_error(a, Image(2, 1, 3), ByteImage(2, 1, 1, 1))));
}

TEST(SurfaceBenchmarks, RefuseNoSamples) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  EXPECT_THROW(measure_geometry(faces, {}, {.samples = 0}), Error);
  EXPECT_THROW(measure_shading(faces, {}, {.samples = 0}), Error);
}

}  // namespace
}  // namespace faceprobe::eval
