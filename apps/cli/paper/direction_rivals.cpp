#include "paper/directions.h"
#include "relight_methods.h"
#include "rival_light_methods.h"

#include <optional>
#include <utility>

namespace faceprobe::cli {

FaceRivals direction_rivals(const RivalSources& sources) {
  const int nside = pipeline::EstimateOptions().solve.nside;
  FaceRivals rivals;
  rivals.methods.push_back(harmonics_of_shading(nside));
  if (sources.training.empty()) {
    rivals.missing =
        "No rows of knorr and kurz and of the mean light of the training data: they learn from traced training faces, "
        "which --training names.";
  } else if (std::optional<FaceLightMethod> learnt = learnt_transfer(sources.training, nside)) {
    rivals.methods.push_back(*std::move(learnt));
  } else {
    rivals.missing = "No row of knorr and kurz: the training faces are not traced (`faceprobe trace`).";
  }
  rivals.methods.push_back(joint_estimate(nside, sources.threads));
  rivals.methods.push_back(lamp_at_brightest_highlight(nside));
  if (!sources.training.empty())
    rivals.methods.push_back(constant_light(kMeanLight, mean_training_light(sources.training, nside)));
  if (std::optional<FaceLightMethod> network = face_network_method(sources.weights, rivals.missing))
    rivals.methods.push_back(*std::move(network));
  return rivals;
}

Sections direction_sections(const PaperPlan& plan) {
  DirectionRows rows{.data = plan.data, .every = plan.direction_step(), .progress = plan.progress};
  rows.base.threads = plan.threads;
  // Without photos nobody has to learn.
  if (has_directions(plan.data))
    rows.rivals = direction_rivals({.training = plan.training, .weights = plan.rivals, .threads = plan.threads});
  return measure_directions(rows);
}

}  // namespace faceprobe::cli
