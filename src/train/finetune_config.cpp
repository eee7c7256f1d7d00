#include "faceprobe/train/finetune.h"

#include "train/config_fields.h"

namespace faceprobe::train {
namespace {

constexpr auto kEachFinetuneField = [](auto& config, const auto& visit) {
  visit("mode", config.mode);
  visit("steps", config.steps, 1, 1e6);
  visit("photos", config.photos, 2, 64);
  visit("synthetic_batch", config.synthetic_batch, 0, 4096);
  visit("learning_rate", config.learning_rate, 1e-9, 1);
  visit("weight", config.weight, 0, 1000);
  visit("energy_weight", config.energy_weight, 0, 100);
  visit("largest_gradient", config.largest_gradient, 1e-6, 1e6);
  visit("ema", config.ema, 0, 0.999999);
  visit("held_out_share", config.held_out_share, 0.001, 0.999);
  visit("score_every", config.score_every, 0, 1e6);
  visit("validation_samples", config.validation_samples, 1, 1e6);
  visit("max_validation_rise", config.max_validation_rise, 0, 1000);
  visit("save_every", config.save_every, 1, 1e6);
  visit("seed", config.seed);
};

}  // namespace

std::string FinetuneConfig::validate() const {
  std::string problem = limits_problem("finetuning", *this, kEachFinetuneField);
  if (problem.empty() && mode != "default" && mode != "paper")
    problem = "The finetuning config's mode is \"" + mode + "\"; there are default and paper.";
  return problem;
}

FinetuneConfig finetune_config_from_json(const std::string& text) {
  return fields_from_json("finetuning", text, FinetuneConfig(), kEachFinetuneField);
}

std::string to_json(const FinetuneConfig& config) { return fields_to_json(config, kEachFinetuneField); }

}  // namespace faceprobe::train
