#include "faceprobe/eval/insert_benchmark.h"

#include "eval/small_faces.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

namespace faceprobe::eval {
namespace {

LightMethod truth_times(float gain) {
  return {"truth x " + std::to_string(gain), [gain](const LightInput& input) {
            return Eigen::MatrixX3f(gain * grid_from_env_map(input.sample.environment, SphereGrid(16)));
          }};
}

TEST(InsertBenchmark, KnowsTheTruthItsStrengthAndNothingElse) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  const InsertScores scores = measure_insertion(faces, {truth_times(1), truth_times(0.5F), ambient_method()},
                                                render::cube(), {.samples = 2, .rays = 64, .rows = 1});
  const auto mean = [&](const std::string& metric, const std::string& method) {
    return scores.table.summary(metric, {.method = method}).mean;
  };
  const std::string truth = truth_times(1).name;
  const std::string half = truth_times(0.5F).name;
  // The same light on another grid, and the noise of 64 rays.
  EXPECT_LT(mean("rmse", truth), 4);
  EXPECT_GT(mean("rmse", half), 3 * mean("rmse", truth));
  EXPECT_GT(mean("rmse", ambient_method().name), 2 * mean("rmse", truth));
  // Its strength is forgiven by "scaled", its direction is not.
  EXPECT_LT(mean("scaled", half), 0.5 * mean("rmse", half));
  EXPECT_GT(mean("scaled", ambient_method().name), 2 * mean("scaled", truth));
  EXPECT_GT(scores.picture.width(), 4 * scores.picture.height());  // photo, truth, three methods
}

TEST(InsertBenchmark, RefusesOptionsThatMakeNoSense) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  EXPECT_THROW(measure_insertion(faces, {}, render::cube(), {.samples = 0}), Error);
  EXPECT_THROW(measure_insertion(faces, {}, render::cube(), {.rays = 0}), Error);
  EXPECT_THROW(measure_insertion(faces, {}, render::Model{}, {}), Error);
}

}  // namespace
}  // namespace faceprobe::eval
