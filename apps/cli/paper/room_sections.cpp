#include "eval_stages.h"
#include "paper/plan.h"

namespace faceprobe::cli {

Sections room_sections(const PaperPlan& plan) {
  const synth::ShardReader groups(plan.groups);
  EvalOptions options;
  options.samples = plan.group_photos();
  options.threads = plan.threads;
  const eval::ScoreTable scores = measure_lamps(groups, options, plan.progress);
  eval::ReportSection section{
      .id = "triangulation",
      .title = "Lamps from several faces",
      .text =
          "The paper's Section 5.4 on synthetic groups: two to four people, lamps at known places, distant light as "
          "well. The paper, in one "
          "scene: faces .19, .44 and .29 m off, lamps .41 and .51 m, with the faces known .20 and .49 m.",
      .command = "faceprobe eval triangulate --data GROUPS"};
  const auto higher = eval::Better::kHigher;
  section.tables = {
      table_of(scores, "face_m", "Faces, metres from where they are", 2),
      table_of(scores, "lamp_m", "Lamps that were found, metres from where they are", 2),
      table_of(scores, "found", "Share of the lamps that were found", 2, {}, higher),
      table_of(scores, "within", "Share of the lamps that were found within .4 m", 2, {}, higher),
      table_of(scores, "covered", "Share of found lamps inside the ellipsoid stated for 95 %", 2, {}, higher),
      table_of(scores, "invented", "Lamps a photo that are not there", 2)};
  section.plots = {cumulative_of(scores, "lamp_m", "Lamps within an error", "metres")};
  section.plots[0].missing_are_largest = true;
  return {section};
}

}  // namespace faceprobe::cli
