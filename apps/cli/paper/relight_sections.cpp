#include "faceprobe/assets/object.h"
#include "faceprobe/eval/paired_column.h"
#include "faceprobe/eval/relight_benchmark.h"
#include "faceprobe/eval/sun_metrics.h"
#include "paper/derived_tables.h"
#include "paper/plan.h"
#include "paper/published.h"
#include "paper/report_names.h"
#include "program_light_methods.h"
#include "relight_methods.h"
#include "rival_light_methods.h"
#include "scene_table.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

namespace {

const std::set<std::string> kOurs = {"transport"};

eval::ReportSection object_section(const eval::RelightScores& scores, bool bunny) {
  const eval::ScoreTable& table = scores.table;
  eval::ReportSection section{
      .id = "relighting",
      .title = "An object in the light that was found",
      .text = std::string(bunny ? "The Stanford bunny" : "A sphere") +
              " under the estimated light against the same under the true one, RMSE of 255: the paper's Table 2 and "
              "the histograms of its "
              "supplement. Photos are 8-bit and clipped, faces are found, layers are the networks'. Each picture is "
              "divided by the brightest "
              "pixel of its own diffuse one, so that a lamp behind the head, which no skin shows, moves everything. "
              "Gardner's and Hold-Geoffroy's networks see the scene behind the head, level, where the photos' cameras "
              "tilt by "
              "some degrees; the first was made for rooms and the second for the open, which the tables by scene tell "
              "apart.",
      .command =
          "faceprobe eval relight --data LIGHT --object DIR/objects/stanford-bunny.obj --scenes DIR/hdri/dev.csv"};
  std::vector<std::pair<std::string, eval::ReportTable>> by_tone;
  for (const char* metric : {"diffuse", "glossy"}) {
    const std::string name = metric == std::string("diffuse") ? "Diffuse object" : "Glossy object";
    section.tables.push_back(paired_table_of(table, metric, name, 1, kOurs));
    if (table.groups().contains("scene"))
      section.tables.push_back(table_by_group(table, metric, "scene", name + " by scene", 1, kOurs));
    by_tone.emplace_back(name, table_by_group(table, metric, "tone", name + " by skin tone", 1, kOurs));
    section.tables.push_back(by_tone.back().second);
    section.plots.push_back(histogram_of(table, metric, name + ": photos by error", "RMSE of 255", kOurs));
  }
  eval::ReportTable spread = worst_over_best(by_tone, "Worst skin tone over the best");
  spread.note =
      "The mean error of the skin tone with the largest over that of the tone with the smallest. Each tone is few "
      "people "
      "in few lights, and some lights are harder: rows that see no skin, such as ambient, have ratios above 1 too, and "
      "intervals by tone are wide. A ratio above 1 is no proof that the skin makes the difference, nor that it does "
      "not.";
  section.tables.push_back(std::move(spread));
  for (eval::ReportTable& published : published_relighting()) section.tables.push_back(std::move(published));
  if (!scores.picture.empty()) {
    std::string caption = "Photo, truth, then ";
    for (const std::string& method : table.methods()) caption += row_name(method) + ", ";
    caption.replace(caption.size() - 2, 2, ". Above the object in each light, below the maps, of the same energy.");
    section.pictures = {{.title = "Objects and maps", .caption = caption, .picture = scores.picture}};
  }
  return section;
}

eval::ReportSection map_section(const eval::ScoreTable& table) {
  return {
      .id = "maps",
      .title = "The maps themselves",
      .text =
          "Three spheres under both lights, after the best scale, as StyleLight and DiffusionLight measure (channels "
          "averaged, not "
          "summed): si-RMSE, the angle between colours, and NRMSE of pictures brought to [0, 1] between their "
          "percentiles .1 and 99.9. Then the supplement's NRMSE of the map: over the estimate's range, as the paper "
          "has "
          "it, and over the truth's, which no bright pixel lowers.",
      .tables = {table_of(table, "si_diffuse", "Diffuse sphere, si-RMSE", 3, kOurs),
                 table_of(table, "si_matte", "Rough metal sphere, si-RMSE", 3, kOurs),
                 table_of(table, "si_mirror", "Mirror sphere, si-RMSE", 3, kOurs),
                 table_of(table, "angle_diffuse", "Diffuse sphere, angle between its colours, degrees", 2, kOurs),
                 table_of_metrics(table, {{"angle_matte", "rough metal"}, {"angle_mirror", "mirror"}},
                                  "The other spheres, angle between their colours, degrees, mean", 2, kOurs),
                 table_of_metrics(
                     table, {{"nrmse_diffuse", "diffuse"}, {"nrmse_matte", "rough metal"}, {"nrmse_mirror", "mirror"}},
                     "Three spheres, NRMSE, mean", 3, kOurs),
                 table_of(table, "nrmse_map", "Map, NRMSE over the estimate's range", 3, kOurs),
                 table_of(table, "nrmse_map_truth", "Map, NRMSE over the truth's range", 3, kOurs),
                 table_of(table, "colour", "Colour of all the light, degrees", 2, kOurs),
                 table_by_group(table, "colour", "tone", "Colour of all the light by skin tone, degrees", 2, kOurs),
                 published_maps()}};
}

eval::ReportSection sun_section(const eval::ScoreTable& table) {
  eval::ReportSection section{
      .id = "sun",
      .title = "The main light, and the sun",
      .text =
          "Of photos that one lamp dominates. The sun, as the supplement has it, is the centroid of the brightest part "
          "of the map; the supplement draws its curve for outdoor scenes and prints no figures."};
  if (table.metrics().contains("main_light"))
    section.tables.push_back(table_of(table, "main_light", "Main light, degrees", 1, kOurs));
  if (!table.metrics().contains("sun_centroid")) {
    section.missing = "No photo's light has one dominant lamp.";
    return section;
  }
  section.tables.push_back(table_of(table, "sun_centroid", "Sun (centroid of the brightest 1 %), degrees", 1, kOurs));
  if (table.groups().contains("scene"))
    section.tables.push_back(table_by_group(table, "sun_centroid", "scene", "Sun by scene, degrees", 1, kOurs));
  section.tables.push_back(sun_table(table, "Photos that have the sun within so many degrees, %", kOurs));
  if (!table.known_values("sun_centroid", {.group = "scene", .label = "outdoor"}).empty()) {
    section.tables.push_back(sun_table(table, "The same of outdoor scenes alone, %", kOurs, "scene", "outdoor"));
  }
  section.tables.push_back(table_of(table, "sun_azimuth", "The sun's azimuth alone, degrees", 1, kOurs));
  section.tables.push_back(table_of(table, "sun_elevation", "The sun's elevation alone, degrees", 1, kOurs));
  section.plots = {cumulative_of(table, "sun_centroid", "Photos within an error of the centroid", "degrees", kOurs)};
  section.plots[0].missing_are_largest = true;
  return section;
}

// Rows of the programs that the plan names; returns what they have no result of.
std::string add_programs(std::vector<eval::LightMethod>& methods, const synth::ShardReader& faces,
                         const PaperPlan& plan) {
  ProgramRows rows{.methods = plan.methods,
                   .seconds = plan.seconds,
                   .samples = plan.light_photos(),
                   .folder = plan.output / "cache",
                   .progress = plan.progress};
  for (const eval::LightMethod& method : methods) rows.taken.insert(method.name);
  ProgramMethods programs = program_light_methods(faces, rows);
  std::move(programs.methods.begin(), programs.methods.end(), std::back_inserter(methods));
  return programs.missing;
}

}  // namespace

Sections relight_sections(const PaperPlan& plan) {
  const synth::ShardReader faces(plan.light);
  std::vector<eval::LightMethod> methods = relight_methods({.training = plan.training, .threads = plan.threads});
  RivalMethods rivals = rival_light_methods(
      {.weights = plan.rivals, .maps = plan.data / "hdri" / "dev", .recipe = faces.recipe(), .threads = plan.threads});
  std::move(rivals.methods.begin(), rivals.methods.end(), std::back_inserter(methods));
  const std::string programs_missing = add_programs(methods, faces, plan);
  const std::filesystem::path bunny = plan.data / "objects" / "stanford-bunny.obj";
  const bool has_bunny = std::filesystem::exists(bunny);
  const eval::LitObject object(has_bunny ? assets::load_object(bunny.string()) : eval::sphere_mesh(),
                               {.threads = plan.threads});
  eval::RelightBenchmark benchmark{
      .samples = plan.light_photos(), .rows = plan.picture_rows(), .progress = plan.progress};
  const std::filesystem::path scenes = plan.data / "hdri" / "dev.csv";
  if (std::filesystem::exists(scenes)) benchmark.scene = scene_of_maps(scenes, faces.recipe());
  const eval::RelightScores scores = eval::measure_relighting(faces, methods, object, benchmark);
  Sections sections = {object_section(scores, has_bunny), map_section(scores.table), sun_section(scores.table)};
  sections[0].missing = rivals.missing + programs_missing;
  if (plan.training.empty()) {
    sections[0].missing +=
        " No row of knorr and kurz: it learns from traced training faces, which --training names. No row of mean light "
        "of the training data: --training names the faces.";
  } else if (std::ranges::count(scores.table.methods(), "knorr and kurz") == 0) {
    sections[0].missing += " No row of knorr and kurz: the training faces are not traced (`faceprobe trace`).";
  }
  if (!std::filesystem::exists(scenes))
    sections[0].missing += " Scenes are not told apart: there is no hdri/dev.csv in the data folder.";
  return sections;
}

}  // namespace faceprobe::cli
