#include "faceprobe/train/train_regressor.h"

#include "train/config_fields.h"

namespace faceprobe::train {
namespace {

constexpr auto kEachRegressorField = [](auto& config, const auto& visit) {
  visit("widths", config.widths);
  visit("picture_px", config.picture_px, 8, 512);
  visit("features", config.features, 1, 512);
  visit("light_size", config.light_size, 1, 64);
  visit("examples", config.examples, 1, 1'000'000);
  visit("batch", config.batch, 1, 4096);
  visit("epochs", config.epochs, 1, 100'000);
  visit("learning_rate", config.learning_rate, 1e-9, 1);
  visit("weight_decay", config.weight_decay, 0, 1);
  visit("average_decay", config.average_decay, 0, 0.999999);
  visit("drop", config.drop, 0, 0.95);
  visit("colour_jitter", config.colour_jitter, 0, 1);
  visit("mask_share", config.mask_share, 0, 1);
  visit("largest_exponent", config.largest_exponent, 1, 1000);
  visit("mask_weight", config.mask_weight, 0, 100);
  visit("intensity_weight", config.intensity_weight, 0, 100);
  visit("rough_weight", config.rough_weight, 0, 100);
  visit("mirror_weight", config.mirror_weight, 0, 100);
  visit("seed", config.seed, 0, 1e18);
};

}  // namespace

RegressorConfig gardner_config() { return {}; }

RegressorConfig legendre_config() {
  RegressorConfig config;
  config.light_size = 8;
  config.examples = 20'000;
  config.epochs = 4;
  return config;
}

std::string RegressorConfig::validate() const { return limits_problem("regressor", *this, kEachRegressorField); }

RegressorConfig regressor_config_from_json(const std::string& text, const RegressorConfig& usual) {
  return fields_from_json("regressor", text, usual, kEachRegressorField);
}

std::string to_json(const RegressorConfig& config) { return fields_to_json(config, kEachRegressorField); }

}  // namespace faceprobe::train
