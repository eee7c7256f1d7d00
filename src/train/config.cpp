#include "faceprobe/train/config.h"

#include "faceprobe/core/error.h"

#include <nlohmann/json.hpp>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

// Calls visit(key, value) for every field, so that reading and writing cannot differ.
template <class Config, class Visit>
void each_field(Config& config, const Visit& visit) {
  visit("architecture", config.architecture);
  visit("batch", config.batch);
  visit("steps", config.steps);
  visit("learning_rate", config.learning_rate);
  visit("weight_decay", config.weight_decay);
  visit("warm_up", config.warm_up);
  visit("final_share", config.final_share);
  visit("average_decay", config.average_decay);
  visit("largest_gradient", config.largest_gradient);
  visit("seed", config.seed);
  visit("validate_every", config.validate_every);
  visit("validation_samples", config.validation_samples);
  visit("save_every", config.save_every);
  visit("mirror", config.augment.mirror);
  visit("colour_deviation", config.augment.colour_deviation);
  visit("exposure_deviation", config.augment.exposure_deviation);
  visit("grey_share", config.augment.grey_share);
  visit("no_mask_share", config.augment.no_mask_share);
  visit("occluder_share", config.augment.occluder_share);
  visit("zoom_share", config.augment.zoom_share);
  visit("cut_share", config.augment.cut_share);
  visit("loss_encoded", config.loss.encoded);
  visit("loss_gradient", config.loss.gradient);
  visit("loss_rms", config.loss.rms);
  visit("loss_similarity", config.loss.similarity);
  visit("loss_elsewhere", config.loss.elsewhere);
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::kUsage, "The training config " + what); }

std::string known_keys() {
  const TrainConfig config;
  std::string keys = "network";
  each_field(config, [&](const char* key, const auto&) { keys += std::string(", ") + key; });
  return keys;
}

std::string outside(const char* name, double value, const char* allowed) {
  return "The training config's " + std::string(name) + " is " + Json(value).dump() + "; allowed is " + allowed + ".";
}

}  // namespace

std::string TrainConfig::validate() const {
  struct Limit {
    const char* name;
    double value, low, high;
    const char* allowed;
  };
  const Limit limits[] = {
      {"batch", static_cast<double>(batch), 1, 4096, "1 to 4096"},
      {"steps", static_cast<double>(steps), 1, 1e9, "1 to 1e9"},
      {"learning_rate", learning_rate, 1e-9, 1, "1e-9 to 1"},
      {"weight_decay", weight_decay, 0, 1, "0 to 1"},
      {"warm_up", static_cast<double>(warm_up), 0, 1e9, "0 to 1e9"},
      {"final_share", final_share, 0, 1, "0 to 1"},
      {"average_decay", average_decay, 0, 0.999999, "0 to 0.999999"},
      {"largest_gradient", largest_gradient, 1e-6, 1e6, "1e-6 to 1e6"},
      {"validate_every", static_cast<double>(validate_every), 1, 1e9, "1 to 1e9"},
      {"validation_samples", static_cast<double>(validation_samples), 1, 1e6, "1 to 1e6"},
      {"save_every", static_cast<double>(save_every), 1, 1e9, "1 to 1e9"},
      {"colour_deviation", augment.colour_deviation, 0, 1, "0 to 1"},
      {"exposure_deviation", augment.exposure_deviation, 0, 2, "0 to 2"},
      {"grey_share", augment.grey_share, 0, 1, "0 to 1"},
      {"no_mask_share", augment.no_mask_share, 0, 1, "0 to 1"},
      {"occluder_share", augment.occluder_share, 0, 1, "0 to 1"},
      {"zoom_share", augment.zoom_share, 0, 1, "0 to 1"},
      {"cut_share", augment.cut_share, 0, 1, "0 to 1"},
      {"loss_encoded", loss.encoded, 0, 100, "0 to 100"},
      {"loss_gradient", loss.gradient, 0, 100, "0 to 100"},
      {"loss_rms", loss.rms, 0, 100, "0 to 100"},
      {"loss_similarity", loss.similarity, 0, 100, "0 to 100"},
      {"loss_elsewhere", loss.elsewhere, 0, 1, "0 to 1"},
  };
  for (const Limit& limit : limits) {
    if (!(limit.value >= limit.low && limit.value <= limit.high))
      return outside(limit.name, limit.value, limit.allowed);
  }
  if (architecture != "unet" && architecture != "mscr") {
    return "The training config's architecture is \"" + architecture + "\"; there are unet and mscr.";
  }
  return {};
}

TrainConfig train_config_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("is not a JSON object.");
  TrainConfig config;
  std::size_t found = 0;
  each_field(config, [&](const char* key, auto& value) {
    if (!json.contains(key)) return;
    ++found;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  });
  if (json.contains("network")) {
    ++found;
    if (!json["network"].is_object()) refuse("has a network that is no JSON object.");
    config.network = json["network"].dump();
  }
  if (found != json.size()) {
    for (const auto& [key, value] : json.items()) {
      bool known = key == "network";
      each_field(config, [&](const char* name, const auto&) { known = known || key == name; });
      if (!known) refuse("has the key \"" + key + "\"; there are: " + known_keys() + ".");
    }
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

std::string to_json(const TrainConfig& config) {
  Json json;
  each_field(config, [&](const char* key, const auto& value) { json[key] = value; });
  json["network"] = Json::parse(config.network);
  return json.dump(1);
}

}  // namespace faceprobe::train
