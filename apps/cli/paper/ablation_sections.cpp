#include "ablation_methods.h"
#include "faceprobe/eval/lit_object.h"
#include "faceprobe/eval/paired_column.h"
#include "faceprobe/eval/relight_benchmark.h"
#include "paper/plan.h"

namespace faceprobe::cli {

Sections ablation_sections(const PaperPlan& plan) {
  const synth::ShardReader faces(plan.light);
  const eval::LitObject sphere(eval::sphere_mesh(), {.threads = plan.threads});
  const eval::RelightScores scores =
      eval::measure_relighting(faces, ablation_methods({.threads = plan.threads}), sphere,
                               {.samples = plan.ablation_photos(), .progress = plan.progress});
  const std::set<std::string> ours = {"as it is"};
  eval::ReportSection section{
      .id = "ablations",
      .title = "What each part is worth",
      .text = "The whole estimate with one part changed at a time, on a sphere in the light that was found.",
      .missing =
          "Finetuning, which changes the network of the highlights alone; its rows are printed by bench/people.sh."};
  section.tables = {paired_table_of(scores.table, "diffuse", "Diffuse sphere, RMSE of 255", 1, ours),
                    paired_table_of(scores.table, "glossy", "Glossy sphere, RMSE of 255", 1, ours)};
  if (scores.table.metrics().contains("main_light"))
    section.tables.push_back(table_of(scores.table, "main_light", "Main light, degrees", 1, ours));
  section.tables.push_back(
      table_by_group(scores.table, "diffuse", "tone", "Diffuse sphere, RMSE of 255, by skin tone", 1, ours));
  section.tables.push_back(table_by_group(scores.table, "diffuse", "turn",
                                          "Diffuse sphere, RMSE of 255, by turn of the head, degrees", 1, ours));
  section.tables.push_back(table_by_group(scores.table, "diffuse", "clipped",
                                          "Diffuse sphere, RMSE of 255, by clipped share of the skin", 1, ours));
  section.tables.push_back(table_by_group(scores.table, "diffuse", "size",
                                          "Diffuse sphere, RMSE of 255, by the skin's share of the crop", 1, ours));
  section.plots = {bars_of(scores.table, "diffuse", "Diffuse sphere", "RMSE of 255", ours)};
  return {section};
}

}  // namespace faceprobe::cli
