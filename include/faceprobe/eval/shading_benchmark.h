#pragma once
// Albedo and shading against synthetic photos that were made of them.
//
//   const synth::ShardReader faces("faces/dev");
//   const eval::ScoreTable scores = eval::measure_shading(faces, methods, {.samples = 200});
//   std::cout << scores.markdown("shading", 3) << scores.markdown("light_colour", 1);

#include "faceprobe/core/image.h"
#include "faceprobe/eval/photo_input.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/synth/shard.h"

#include <functional>
#include <string>
#include <vector>

namespace faceprobe::eval {

// What matters is the skin.
struct ShadingEstimate {
  Image albedo;   // H x W x 3, linear, at any scale
  Image shading;  // H x W x 3, the same
};

struct ShadingMethod {
  std::string name;
  std::function<ShadingEstimate(const PhotoInput&)> split;
};
// The whole photo as shading, on a skin of one colour: what everything has to be better than.
ShadingMethod one_albedo_method();

struct ShadingBenchmark {
  int samples = 200;  // of as many people as possible; those that show less than 5 % skin are left out
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

// Metrics of each row, over skin that is not clipped: albedo and shading, root mean square error over the root mean square of the truth
// after the best scale (Grosse et al. 2009, one window); light_colour, the angle between the mean
// shadings, degrees. Group: tone. Throws Error(kUsage) for options that do not validate.
ScoreTable measure_shading(const synth::ShardReader& faces, const std::vector<ShadingMethod>& methods,
                           const ShadingBenchmark& options);

// 0 when one is a multiple of the other, 1 when they have nothing in common. Of H x W x 3 pictures over the pixels of a mask; NaN when the
// truth is 0 there.
double scale_invariant_error(const Image& estimate, const Image& truth, const ByteImage& mask);

}  // namespace faceprobe::eval
