#pragma once
// Highlight separators against synthetic photos whose highlight layer is known: the paper's Table 1, upper half, on our faces.
//
//   const synth::ShardReader faces("faces/dev");
//   const std::vector<eval::HighlightMethod> methods = {eval::black_method(), ...};
//   const eval::ScoreTable scores = eval::measure_highlights(faces, methods, {.samples = 100});
//   std::cout << scores.markdown("rmse_skin", 2);
//
// Two views of each photo: the face alone, which is what the light is read from (the method is given the face's mask and judged on its
// skin), and the whole crop (no mask and no mesh; hair, clothes and background count).

#include "faceprobe/core/image.h"
#include "faceprobe/eval/photo_input.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/synth/shard.h"

#include <functional>
#include <string>
#include <vector>

namespace faceprobe::eval {

struct HighlightMethod {
  std::string name;
  std::function<Image(const PhotoInput&)> highlight;  // H x W x 3
};
// No highlight at all: what everything has to be better than.
HighlightMethod black_method();

struct HighlightBenchmark {
  int samples = 100;  // of as many people as possible; those that show less than 5 % skin are left out
  // Photos made grey before a method sees them: three equal channels in, the mean of three out, against the mean of the true layer's (paper,
  // Sec. 5.2).
  bool grey = false;
  int threads = 0;
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

// Metrics of each row: rmse_skin, psnr_skin, ssim_skin, rmse_whole, psnr_whole, ssim_whole (image_metrics.h, 0-255). Groups: tone (skin_tone.h, of the true
// albedo), clipped (share of the face's skin), size (of the face's skin in the crop). Throws Error(kUsage) for options that do not
// validate.
ScoreTable measure_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods,
                              const HighlightBenchmark& options);

// Rows of photo, known highlight, and each method's (twice as bright as they are), for looking at.
ByteImage draw_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods, int rows);

}  // namespace faceprobe::eval
