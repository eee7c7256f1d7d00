#include "faceprobe/train/train_sky.h"

#include "train/config_fields.h"

#include <algorithm>

namespace faceprobe::train {
namespace {

constexpr auto kEachSkyField = [](auto& config, const auto& visit) {
  visit("widths", config.widths);
  visit("px", config.px, 32, 512);
  visit("hidden", config.hidden, 1, 2048);
  visit("crops_per_map", config.crops_per_map, 2, 4096);
  visit("batch", config.batch, 2, 4096);
  visit("epochs", config.epochs, 1, 100'000);
  visit("learning_rate", config.learning_rate, 1e-9, 1);
  visit("weight_decay", config.weight_decay, 0, 1);
  visit("drop", config.drop, 0, 0.95);
  visit("numbers_weight", config.numbers_weight, 0, 1000);
  visit("sun_concentration", config.sun_concentration, 1, 1000);
  visit("least_view_deg", config.least_view_deg, 10, 150);
  visit("most_view_deg", config.most_view_deg, 10, 150);
  visit("most_pitch_deg", config.most_pitch_deg, 0, 60);
  visit("exposure_spread", config.exposure_spread, 0, 2);
  visit("colour_spread", config.colour_spread, 0, 1);
  visit("seed", config.seed, 0, 1e18);
};

}  // namespace

std::string SkyConfig::validate() const {
  std::string problem = limits_problem("sky", *this, kEachSkyField);
  const bool sizes = std::ranges::all_of(widths, [](int size) { return size >= 1 && size <= 2048; });
  if (problem.empty() && (widths.size() != 7 || !sizes))
    problem = "The sky config's widths must list 7 sizes of 1 to 2048.";
  if (problem.empty() && px % 32 != 0)
    problem = "The sky config's px is " + std::to_string(px) + "; it must be a multiple of 32.";
  if (problem.empty() && least_view_deg > most_view_deg)
    problem = "The sky config's least_view_deg is above its most_view_deg; swap them.";
  return problem;
}

SkyConfig sky_config_from_json(const std::string& text) {
  return fields_from_json("sky", text, SkyConfig(), kEachSkyField);
}

std::string to_json(const SkyConfig& config) { return fields_to_json(config, kEachSkyField); }

}  // namespace faceprobe::train
