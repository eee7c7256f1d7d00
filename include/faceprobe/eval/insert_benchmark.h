#pragma once
// Insertion against the truth: a thing drawn into synthetic photos by the light that was found in them, beside the same thing drawn by the light
// that was really there. Unlike relighting (relight_benchmark.h) it asks for the light's strength too, as a photo does.
//
//   const synth::ShardReader faces("faces/light");
//   const eval::InsertScores scores = eval::measure_insertion(faces, methods, render::shape("spheres"), {.samples = 50});
//   std::cout << scores.table.markdown("rmse", 1);

#include "faceprobe/eval/relight_benchmark.h"
#include "faceprobe/render/model.h"

namespace faceprobe::eval {

struct InsertBenchmark {
  int samples = 50;  // photos, of as many people as possible; those that show less than 5 % skin are left out
  int rays = 128;    // per pixel; what noise they leave counts as error
  int nside = 16;    // of the methods' sphere grid
  int rows = 0;      // of photos in the picture
  int threads = 0;
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

struct InsertScores {
  ScoreTable table;
  ByteImage picture;  // photo, the thing in the true light, and in each method's
};

// `model`: any place and size; it is stood into the lower corner, nearer than the face. Metrics, in sRGB of 0..255 over what the true picture
// changes of the photo: "rmse", of the whole; "scaled", after the exposure of the thing that suits it best, within two stops, since a face
// does not tell how white its skin is; "shadow", of the ground alone. Group: tone. Throws Error(kUsage) for options that do not validate.
InsertScores measure_insertion(const synth::ShardReader& faces, const std::vector<LightMethod>& methods,
                               const render::Model& model, const InsertBenchmark& options);

}  // namespace faceprobe::eval
