#include "faceprobe/eval/relight_benchmark.h"

#include "eval/small_faces.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/sun_metrics.h"

#include <gtest/gtest.h>

namespace faceprobe::eval {
namespace {

LightMethod truth_method() {
  return {"truth", [](const LightInput& input) {
            return Eigen::MatrixX3f(2 * grid_from_env_map(input.sample.environment, SphereGrid(16)));
          }};
}

TEST(RelightBenchmark, TheTruthHasNoErrorAndEverythingElseHas) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const LitObject sphere(sphere_mesh(32), {.size_px = 24});
  const std::vector<LightMethod> methods = {
      truth_method(), ambient_method(), harmonics_method(2), harmonics_method(5), {"blind", [](const LightInput&) {
                                                                                     return Eigen::MatrixX3f();
                                                                                   }}};
  const RelightScores scores = measure_relighting(faces, methods, sphere, {.samples = 3, .rows = 2});
  const auto mean = [&](const std::string& metric, const std::string& method) {
    return scores.table.summary(metric, {.method = method}).mean;
  };
  EXPECT_NEAR(mean("diffuse", "truth"), 0, 1e-3);  // float rounding
  EXPECT_NEAR(mean("glossy", "truth"), 0, 1e-3);
  EXPECT_NEAR(mean("main_light", "truth"), 0, 1e-3);
  EXPECT_GT(mean("diffuse", "ambient"), 20);
  // More harmonics, nearer the truth.
  EXPECT_GT(mean("glossy", "ambient"), mean("glossy", "truth in harmonics of order 2"));
  EXPECT_GT(mean("glossy", "truth in harmonics of order 2"), mean("glossy", "truth in harmonics of order 5"));
  EXPECT_LT(mean("main_light", "truth in harmonics of order 5"), 3);
  EXPECT_EQ(scores.table.summary("diffuse", {.method = "blind"}).missing, 3U);
  EXPECT_EQ(scores.table.summary("diffuse", {.method = "truth"}).count, 3U);
  EXPECT_EQ(scores.picture.width(), 24 * 7);
  EXPECT_EQ(scores.picture.height(), 2 * 36);
}

TEST(RelightBenchmark, TellsScenesApartWhereTheyAreKnown) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const LitObject sphere(sphere_mesh(16), {.size_px = 16});
  const RelightScores scores = measure_relighting(
      faces, {ambient_method()}, sphere,
      {.samples = 3, .scene = [](int map) { return map == 0 ? std::string("indoor") : std::string("outdoor"); }});
  EXPECT_EQ(scores.table.labels("scene"), std::vector<std::string>{"indoor"});
  EXPECT_TRUE(scores.picture.empty());
}

TEST(RelightBenchmark, TellsClippedShareAndSizeOfTheSkin) {
  SmallFaces small;
  // Three of the ball's 26 rows are over the end.
  synth::Sample clipped = small.truth;
  for (int y = 16; y < 19; ++y) {
    for (int x = 0; x < SmallFaces::kSize; ++x) clipped.clip(x, y) = 7;
  }
  const std::filesystem::path data = small.folder / "clipped";
  const synth::ShardWriter writer(data,
                                  {.size_px = SmallFaces::kSize, .environment_height = 16, .recipe = R"({"seed":1})"});
  writer.write(0, std::vector<synth::ViewSamples>{{small.view, {small.truth, clipped}}});
  writer.finish(1, "");
  const synth::ShardReader faces(data);
  const LitObject sphere(sphere_mesh(16), {.size_px = 16});
  const RelightScores scores = measure_relighting(faces, {ambient_method()}, sphere, {.samples = 2});
  EXPECT_EQ(scores.table.labels("clipped"), (std::vector<std::string>{"none", "5 % and more"}));
  // A disc of 13.3 px' radius in 32 x 32.
  EXPECT_EQ(scores.table.labels("size"), std::vector<std::string>{"25 % and more"});
  // Both show the same person.
  EXPECT_EQ(scores.table.summary("diffuse").people, 1U);
}

TEST(RelightBenchmark, TheMeanLightOfOneLightIsThatLight) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const SphereGrid grid(16);
  const Eigen::MatrixX3f mean = mean_light(faces, 3);
  const Eigen::MatrixX3f one = grid_from_env_map(small.truth.environment, grid);
  EXPECT_LT((mean / mean.mean() - one / one.mean()).cwiseAbs().maxCoeff() / (one / one.mean()).maxCoeff(),
            2e-3);  // stored in half precision
}

TEST(RelightBenchmark, MeasuresWhereTheSunIs) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const LitObject sphere(sphere_mesh(16), {.size_px = 16});
  const RelightScores scores =
      measure_relighting(faces, {truth_method(), harmonics_method(5), ambient_method()}, sphere, {.samples = 3});
  for (const char* metric : {"sun_centroid", "sun_azimuth", "sun_elevation"}) {
    EXPECT_NEAR(scores.table.summary(metric, {.method = "truth"}).mean, 0, 1e-3) << metric;  // float rounding
    EXPECT_EQ(scores.table.summary(metric, {.method = "ambient"}).missing, 3U) << metric;
    // Harmonics have the lamp's middle where it is, but for the surround.
    EXPECT_LT(scores.table.summary(metric, {.method = "truth in harmonics of order 5"}).mean, 5) << metric;
  }
  EXPECT_NE(sun_markdown(scores.table).find("| ambient | 3 (3 missing) | 0 %"), std::string::npos);
}

TEST(RelightBenchmark, RefusesOptionsThatMakeNoSense) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const LitObject sphere(sphere_mesh(16), {.size_px = 16});
  EXPECT_THROW(measure_relighting(faces, {}, sphere, {.samples = 0}), Error);
  EXPECT_THROW(measure_relighting(faces, {}, sphere, {.rows = -1}), Error);
}

}  // namespace
}  // namespace faceprobe::eval
