#include "faceprobe/core/error.h"
#include "faceprobe/face/face.h"
#include "faceprobe/pipeline/found_meshes.h"
#include "faceprobe/synth/generate.h"
#include "paper/plan.h"
#include "synth_assets.h"

#include <spdlog/spdlog.h>

namespace faceprobe::cli {

namespace {

// The recipes of docs/training.md; a quick run makes fewer of the same.
synth::Recipe faces_recipe(bool quick) {
  return {.count = quick ? 256 : 2000, .size_px = 128, .seed = 2, .split = synth::Split::kDev};
}
// Every person once: what is measured on four photos of one person is said of that person. Each skin of a person has one photo.
synth::Recipe light_recipe(bool quick) {
  return {.count = quick ? 64 : 400,
          .size_px = 256,
          .seed = 7,
          .split = synth::Split::kDev,
          .views_per_person = 1,
          .samples_per_view = 4};
}
synth::Recipe groups_recipe(bool quick) {
  return {.count = quick ? 2 : 100,
          .size_px = 768,
          .seed = 3,
          .split = synth::Split::kDev,
          .multi_face = true,
          .people = 3,
          .lamps = 2,
          .lamp_distance_m = {{1.0, 4.0}},
          .views_per_person = 1,
          .samples_per_view = 1};
}
// Other people than the groups above, under their maps alone.
synth::Recipe distant_recipe(bool quick) {
  synth::Recipe recipe = groups_recipe(quick);
  recipe.count = quick ? 2 : 20;
  recipe.seed = 4;
  recipe.lamps = 0;
  recipe.lamp_distance_m.reset();
  return recipe;
}

}  // namespace

void make_paper_faces(PaperPlan& plan) {
  struct Set {
    std::filesystem::path* folder;
    const char* name;
    synth::Recipe recipe;
    bool meshes;
    bool needed;
  };
  const std::vector<Set> sets = {
      {&plan.faces, "faces", faces_recipe(plan.quick), true, plan.measures("highlights")},
      {&plan.light, "light", light_recipe(plan.quick), true, plan.measures("relighting") || plan.measures("ablations")},
      {&plan.groups, "groups", groups_recipe(plan.quick), false, plan.measures("triangulation")},
      // Beside groups that are made: who names some measures those.
      {&plan.distant, "distant", distant_recipe(plan.quick), false,
       plan.measures("triangulation") && plan.groups.empty()}};
  synth::Assets assets;
  for (const Set& set : sets) {
    if (!set.needed || !set.folder->empty()) continue;
    const std::filesystem::path folder = plan.output / (plan.quick ? "faces_quick" : "faces") / set.name;
    if (assets.heads.empty()) {
      assets = load_synth_assets({.packed = {},
                                  .heads = {(plan.data / "faces" / "ict_facekit").string()},
                                  .skins = (plan.data / "faces" / "london_uv_textures").string(),
                                  .maps = (plan.data / "hdri" / "dev").string(),
                                  .reflectance = {},
                                  .mixed_maps = {},
                                  .threads = plan.threads});
    }
    const synth::DatasetReport report = synth::generate_dataset(
        assets, set.recipe, folder, {.threads = plan.threads}, [&](const synth::RunState& state) {
          if (plan.progress) plan.progress(state.samples_done, state.samples_total);
        });
    if (set.meshes) {
      const face::FaceFinder finder({.min_face_px = face::kSmallFacePx, .threads = plan.threads});
      pipeline::find_meshes(folder, finder);
    }
    spdlog::info("{}: {} synthetic photos", folder.string(), report.state.samples_done);
    *set.folder = folder;
  }
}

}  // namespace faceprobe::cli
