#include "eval_stages.h"
#include "faceprobe/assets/named_model.h"
#include "faceprobe/eval/insert_benchmark.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "relight_methods.h"

#include <spdlog/fmt/fmt.h>

namespace faceprobe::cli {

int eval_insert(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  const std::vector<eval::LightMethod> methods =
      insert_methods({.weights = options.weights.empty() ? "" : name_and_file(options.weights[0]).second,
                      .prior = options.prior,
                      .threads = options.threads});
  const render::Model model = assets::model_named(options.object.empty() ? "spheres" : options.object).model;
  eval::InsertScores scores = eval::measure_insertion(faces, methods, model,
                                                      {.samples = options.samples,
                                                       .rows = options.output.empty() ? 0 : options.rows,
                                                       .threads = options.threads,
                                                       .progress = eval_progress()});
  scores.table.compare_with(methods.front().name);  // the whole estimate
  const eval::ScoreTable& table = scores.table;
  fmt::print("{} photos of {}.\n", table.rows().size() / methods.size(), options.data);
  fmt::print("\n### What the object changes of the photo, RMSE of 255\n\n{}", table.markdown("rmse", 1));
  fmt::print("\n### The same after the best exposure of the object, within two stops\n\n{}",
             table.markdown("scaled", 1));
  fmt::print("\n### Its shadow alone\n\n{}", table.markdown("shadow", 1));
  fmt::print("\n### By skin tone\n\n{}", table.markdown_by_group("rmse", "tone", 1));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "insert.csv", table.csv());
  io::write_file_atomically(folder / "insert.json", table.json());
  if (!scores.picture.empty()) io::write_picture(folder / "insert.png", scores.picture);
  return 0;
}

}  // namespace faceprobe::cli
