#include "faceprobe/train/train_light.h"

#include "train/config_fields.h"

#include <algorithm>

namespace faceprobe::train {
namespace {

constexpr auto kEachLightField = [](auto& config, const auto& visit) {
  visit("hidden", config.hidden);
  visit("batch", config.batch, 1, 65536);
  visit("epochs", config.epochs, 1, 100'000);
  visit("learning_rate", config.learning_rate, 1e-9, 1);
  visit("weight_decay", config.weight_decay, 0, 1);
  visit("average_decay", config.average_decay, 0, 0.999999);
  visit("drop", config.drop, 0, 0.95);
  visit("input_drop", config.input_drop, 0, 0.95);
  visit("input_noise", config.input_noise, 0, 10);
  visit("grey_share", config.grey_share, 0, 1);
  visit("lobe_weight", config.lobe_weight, 0, 100);
  visit("shape_weight", config.shape_weight, 0, 100);
  visit("seed", config.seed, 0, 1e18);
};

}  // namespace

std::string LightConfig::validate() const {
  std::string problem = limits_problem("light", *this, kEachLightField);
  const bool sizes = std::ranges::all_of(hidden, [](int size) { return size >= 1 && size <= 16384; });
  if (problem.empty() && (hidden.empty() || hidden.size() > 8 || !sizes))
    problem = "The light config's hidden must list 1 to 8 sizes of 1 to 16384.";
  return problem;
}

LightConfig light_config_from_json(const std::string& text) {
  return fields_from_json("light", text, LightConfig(), kEachLightField);
}

std::string to_json(const LightConfig& config) { return fields_to_json(config, kEachLightField); }

}  // namespace faceprobe::train
