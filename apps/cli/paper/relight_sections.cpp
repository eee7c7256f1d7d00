#include "faceprobe/assets/object.h"
#include "faceprobe/eval/relight_benchmark.h"
#include "faceprobe/eval/sun_metrics.h"
#include "paper/plan.h"
#include "paper/published.h"
#include "relight_methods.h"
#include "rival_light_methods.h"
#include "scene_table.h"

#include <algorithm>
#include <iterator>
#include <utility>

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
  for (const char* metric : {"diffuse", "glossy"}) {
    const std::string name = metric == std::string("diffuse") ? "Diffuse object" : "Glossy object";
    section.tables.push_back(table_of(table, metric, name, 1, kOurs));
    if (table.groups().contains("scene"))
      section.tables.push_back(table_by_group(table, metric, "scene", name + " by scene", 1, kOurs));
    section.tables.push_back(table_by_group(table, metric, "tone", name + " by skin tone", 1, kOurs));
    section.plots.push_back(histogram_of(table, metric, name + ": photos by error", "RMSE of 255", kOurs));
  }
  section.tables.push_back(published_relighting());
  if (!scores.picture.empty()) {
    std::string caption = "Photo, truth, then ";
    for (const std::string& method : table.methods()) caption += method + ", ";
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
          "summed), and the supplement's NRMSE: over the estimate's range, as the paper has it, and over the truth's, "
          "which no bright "
          "pixel lowers.",
      .tables = {table_of(table, "si_diffuse", "Diffuse sphere", 3, kOurs),
                 table_of(table, "si_matte", "Rough metal sphere", 3, kOurs),
                 table_of(table, "si_mirror", "Mirror sphere", 3, kOurs),
                 table_of(table, "angle_diffuse", "Diffuse sphere, angle of its colours, degrees", 2, kOurs),
                 table_of(table, "nrmse_map", "Map, NRMSE over the estimate's range", 3, kOurs),
                 table_of(table, "nrmse_map_truth", "Map, NRMSE over the truth's range", 3, kOurs),
                 table_of(table, "colour", "Colour of all the light, degrees", 2, kOurs),
                 table_by_group(table, "colour", "tone", "Colour of all the light by skin tone, degrees", 2, kOurs)}};
}

eval::ReportSection sun_section(const eval::ScoreTable& table) {
  eval::ReportSection section{
      .id = "sun",
      .title = "The main light, and the sun",
      .text = "Of photos that one lamp dominates. The sun is the centroid of the brightest part of the map."};
  if (table.metrics().contains("main_light"))
    section.tables.push_back(table_of(table, "main_light", "Main light, degrees", 1, kOurs));
  if (!table.metrics().contains("sun_centroid")) {
    section.missing = "No photo's light has one dominant lamp.";
    return section;
  }
  section.tables.push_back(table_of(table, "sun_centroid", "Centroid, degrees", 1, kOurs));
  if (table.groups().contains("scene"))
    section.tables.push_back(table_by_group(table, "sun_centroid", "scene", "Centroid by scene, degrees", 1, kOurs));
  section.tables.push_back(table_of(table, "sun_azimuth", "Azimuth alone, degrees", 1, kOurs));
  section.tables.push_back(table_of(table, "sun_elevation", "Elevation alone, degrees", 1, kOurs));
  section.plots = {cumulative_of(table, "sun_centroid", "Photos within an error of the centroid", "degrees", kOurs)};
  section.plots[0].missing_are_largest = true;
  return section;
}

}  // namespace

Sections relight_sections(const PaperPlan& plan) {
  const synth::ShardReader faces(plan.light);
  std::vector<eval::LightMethod> methods = relight_methods({.training = plan.training, .threads = plan.threads});
  RivalMethods rivals = rival_light_methods(
      {.weights = plan.rivals, .maps = plan.data / "hdri" / "dev", .recipe = faces.recipe(), .threads = plan.threads});
  std::move(rivals.methods.begin(), rivals.methods.end(), std::back_inserter(methods));
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
  sections[0].missing = rivals.missing;
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
