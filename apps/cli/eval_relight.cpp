#include "eval_stages.h"
#include "faceprobe/assets/object.h"
#include "faceprobe/eval/relight_benchmark.h"
#include "faceprobe/eval/sun_metrics.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "relight_methods.h"
#include "scene_table.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <string>
#include <utility>

namespace faceprobe::cli {

namespace {

void print(const eval::ScoreTable& table, const std::string& title, const std::string& metric, int decimals) {
  fmt::print("\n### {}\n\n{}", title, table.markdown(metric, decimals));
}

void print_groups(const eval::ScoreTable& table, const std::string& title, const std::string& metric,
                  const std::string& group, int decimals) {
  if (table.groups().contains(group))
    fmt::print("\n### {}\n\n{}", title, table.markdown_by_group(metric, group, decimals));
}

void print_suns(const eval::ScoreTable& table) {
  const std::string all = eval::sun_markdown(table);
  if (all.empty()) return;
  print(table, "Sun (centroid of the brightest 1 %), degrees", "sun_centroid", 1);
  print_groups(table, "The same by scene", "sun_centroid", "scene", 1);
  print(table, "The sun's azimuth alone, degrees", "sun_azimuth", 1);
  print(table, "The sun's elevation alone, degrees", "sun_elevation", 1);
  fmt::print(
      "\n### Sun: share of photos within N degrees, and the 75 % mark\n\nOf photos that one lamp dominates.\n\n{}", all);
  if (const std::string outdoor = eval::sun_markdown(table, "scene", "outdoor"); !outdoor.empty())
    fmt::print("\n### The same, outdoor scenes alone\n\n{}", outdoor);
}

// Three spheres by three measures, and the maps by two.
void print_maps(const eval::ScoreTable& table) {
  constexpr std::pair<const char*, const char*> kSpheres[] = {
      {"Diffuse", "diffuse"}, {"Rough metal", "matte"}, {"Mirror", "mirror"}};
  for (const auto& [name, metric] : kSpheres) {
    const std::string sphere = std::string(name) + " sphere, ";
    print(table, sphere + "si-RMSE", std::string("si_") + metric, 3);
    print(table, sphere + "angle between its colours, degrees", std::string("angle_") + metric, 2);
    print(table, sphere + "NRMSE", std::string("nrmse_") + metric, 3);
  }
  print(table, "Map, NRMSE over the estimate's range", "nrmse_map", 3);
  print(table, "Map, NRMSE over the truth's range", "nrmse_map_truth", 3);
}

}  // namespace

int eval_relight(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  const std::vector<eval::LightMethod> methods =
      relight_methods({.weights = options.weights.empty() ? "" : name_and_file(options.weights[0]).second,
                       .prior = options.prior,
                       .training = options.training,
                       .ablation = options.ablation,
                       .threads = options.threads});
  const eval::LitObject object(options.object.empty() ? eval::sphere_mesh() : assets::load_object(options.object),
                               {.threads = options.threads});
  eval::RelightBenchmark benchmark{
      .samples = options.samples, .rows = options.output.empty() ? 0 : options.rows, .progress = eval_progress()};
  if (!options.scenes.empty()) benchmark.scene = scene_of_maps(options.scenes, faces.recipe());
  eval::RelightScores scores = eval::measure_relighting(faces, methods, object, benchmark);
  scores.table.compare_with(methods.front().name);  // the whole estimate
  const eval::ScoreTable& table = scores.table;
  fmt::print("{} photos of {}.\n", table.rows().size() / std::max<std::size_t>(1, methods.size()), options.data);
  print(table, "Diffuse object, RMSE of 255", "diffuse", 1);
  print_groups(table, "The same by scene", "diffuse", "scene", 1);
  print(table, "Glossy object, RMSE of 255", "glossy", 1);
  print_groups(table, "The same by scene", "glossy", "scene", 1);
  print(table, "Main light, degrees, of photos that one lamp dominates", "main_light", 1);
  print_suns(table);
  print(table, "Colour of all the light, degrees", "colour", 2);
  print_groups(table, "The same by skin tone", "colour", "tone", 2);
  print_groups(table, "Diffuse object by skin tone", "diffuse", "tone", 1);
  print_groups(table, "Diffuse object by clipped share of the skin", "diffuse", "clipped", 1);
  print_groups(table, "Diffuse object by the skin's share of the crop", "diffuse", "size", 1);
  print_maps(table);
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "relight.csv", table.csv());
  io::write_file_atomically(folder / "relight.json", table.json());
  if (!scores.picture.empty()) io::write_picture(folder / "relight.png", scores.picture);
  return 0;
}

}  // namespace faceprobe::cli
