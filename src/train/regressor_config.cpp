#include "faceprobe/core/error.h"
#include "faceprobe/train/train_regressor.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace faceprobe::train {
namespace {

using RegressorJson = nlohmann::ordered_json;

// Calls visit(key, value, low, high) for every number.
template <class Config, class Visit>
void each_regressor_number(Config& config, const Visit& visit) {
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
}

[[noreturn]] void refuse_regressor(const std::string& what) {
  throw Error(ExitCode::kUsage, "The regressor config " + what);
}

}  // namespace

RegressorConfig gardner_config() { return {}; }

RegressorConfig legendre_config() {
  RegressorConfig config;
  config.light_size = 8;
  config.examples = 20'000;
  config.epochs = 4;
  return config;
}

std::string RegressorConfig::validate() const {
  std::string problem;
  each_regressor_number(*this, [&](const char* key, const auto& value, double low, double high) {
    const auto number = static_cast<double>(value);
    if (problem.empty() && !(number >= low && number <= high)) {
      problem = "The regressor config's " + std::string(key) + " is " + RegressorJson(number).dump() + "; allowed is " +
                RegressorJson(low).dump() + " to " + RegressorJson(high).dump() + ".";
    }
  });
  return problem;
}

RegressorConfig regressor_config_from_json(const std::string& text, const RegressorConfig& usual) {
  const RegressorJson json = RegressorJson::parse(text, nullptr, false);
  if (!json.is_object()) refuse_regressor("is not a JSON object.");
  RegressorConfig config = usual;
  std::set<std::string> known = {"widths"};
  const auto read = [&](const char* key, auto& value) {
    if (!json.contains(key)) return;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse_regressor(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  };
  read("widths", config.widths);
  each_regressor_number(config, [&](const char* key, auto& value, double, double) {
    known.insert(key);
    read(key, value);
  });
  for (const auto& [key, value] : json.items()) {
    if (known.contains(key)) continue;
    std::string keys;
    for (const std::string& name : known) keys += keys.empty() ? name : ", " + name;
    refuse_regressor("has the key \"" + key + "\"; there are: " + keys + ".");
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

std::string to_json(const RegressorConfig& config) {
  RegressorJson json = {{"widths", config.widths}};
  each_regressor_number(config, [&](const char* key, const auto& value, double, double) { json[key] = value; });
  return json.dump(1);
}

}  // namespace faceprobe::train
