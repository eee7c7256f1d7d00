#include "eval_stages.h"
#include "paper/plan.h"

namespace faceprobe::cli {

namespace {

EvalOptions options_for(const PaperPlan& plan, int photos) {
  EvalOptions options;
  options.samples = photos;
  options.threads = plan.threads;
  return options;
}

}  // namespace

Sections room_sections(const PaperPlan& plan) {
  const synth::ShardReader groups(plan.groups);
  const eval::ScoreTable scores = measure_lamps(groups, options_for(plan, plan.group_photos()), plan.progress);
  eval::ReportSection section{
      .id = "triangulation",
      .title = "Lamps from several faces",
      .text =
          "The paper's Section 5.4 on synthetic groups: people beside one another, lamps at known places near them, "
          "distant light as well; those that this report makes have three people and two lamps 1 to 4 m from every "
          "face. The paper, in one "
          "scene: faces .19, .44 and .29 m off, lamps .41 and .51 m, with the faces known .20 and .49 m.",
      .command = "faceprobe eval triangulate --data GROUPS"};
  const auto higher = eval::Better::kHigher;
  section.tables = {
      table_of(scores, "face_m", "Faces, metres from where they are", 2),
      table_of(scores, "lamp_m", "Lamps that were found, metres from where they are", 2),
      table_of(scores, "found", "Share of the lamps that were found", 2, {}, higher),
      table_of(scores, "within", "Share of the lamps that were found within .4 m", 2, {}, higher),
      table_of(scores, "covered", "Share of found lamps inside the ellipsoid stated for 95 %", 2, {}, higher),
      table_of(scores, "invented", "Lamps a photo that are not there", 2),
      table_of(scores, "inventing", "Share of the photos with a lamp that is not there", 2)};
  section.plots = {cumulative_of(scores, "lamp_m", "Lamps within an error", "metres")};
  section.plots[0].missing_are_largest = true;
  if (plan.distant.empty()) {
    section.missing =
        "How often a near lamp is found where there is none: --distant names no groups under distant "
        "light alone.";
    return {section};
  }
  const synth::ShardReader distant(plan.distant);
  const eval::ScoreTable lampless = measure_lamps(distant, options_for(plan, plan.distant_photos()), plan.progress);
  section.tables.push_back(table_of(lampless, "inventing",
                                    "Share of the photos under distant light alone with a lamp that is not there", 2));
  return {section};
}

}  // namespace faceprobe::cli
