#include "faceprobe/eval/highlight_benchmark.h"

#include "eval/small_faces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::eval {
namespace {

// The small faces are matt: a layer of one value is off by that value everywhere.
HighlightMethod even_layer(float value) {
  return {"even",
          [value](const PhotoInput& input) { return Image(input.linear.width(), input.linear.height(), 3, value); }};
}

TEST(HighlightBenchmark, SignalToNoiseIsTheErrorsOnSkinAndOnTheWholeCrop) {
  const SmallFaces small;
  const ScoreTable scores =
      measure_highlights(synth::ShardReader(small.path()), {even_layer(0.1F), black_method()}, {.samples = 1});
  for (const char* place : {"skin", "whole"}) {
    EXPECT_NEAR(scores.summary(std::string("rmse_") + place, {.method = "even"}).mean, 25.5, 1e-3) << place;
    EXPECT_NEAR(scores.summary(std::string("psnr_") + place, {.method = "even"}).mean, 20, 1e-3) << place;  // 20 lg 10
    EXPECT_NEAR(scores.summary(std::string("rmse_") + place, {.method = "black layer"}).mean, 0, 1e-3) << place;
  }
}

TEST(HighlightBenchmark, TheWholeCropCountsWhatIsNotSkin) {
  const SmallFaces small;
  const HighlightMethod beside{"beside", [](const PhotoInput& input) {
                                 Image layer(input.linear.width(), input.linear.height(), 3);
                                 for (int y = 0; y < layer.height(); ++y) layer(0, y, 0) = 0.6F;  // left of the ball
                                 return layer;
                               }};
  const ScoreTable scores = measure_highlights(synth::ShardReader(small.path()), {beside}, {.samples = 1});
  EXPECT_NEAR(scores.summary("rmse_skin").mean, 0, 1e-3);
  // One of 32 columns, one of three channels.
  EXPECT_NEAR(scores.summary("psnr_whole").mean, -20 * std::log10(0.6 * std::sqrt(1 / 96.0)), 1e-3);
}

}  // namespace
}  // namespace faceprobe::eval
