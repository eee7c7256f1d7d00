#include "faceprobe/train/config.h"

#include "faceprobe/core/error.h"

#include <nlohmann/json.hpp>
#include <type_traits>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

struct Limits {
  double low = 0, high = 0;
  const char* allowed = nullptr;
};
constexpr Limits kCount{1, 1e9, "1 to 1e9"};
constexpr Limits kShare{0, 1, "0 to 1"};
constexpr Limits kWeight{0, 100, "0 to 100"};
constexpr Limits kAny{};  // of what is no number, or any number

// Calls visit(key, value, limits) for every field, so that reading, writing and checking cannot differ.
template <class Config, class Visit>
void each_field(Config& config, const Visit& visit) {
  visit("architecture", config.architecture, kAny);
  visit("picture_px", config.picture_px, Limits{0, 1024, "0 to 1024"});
  visit("batch", config.batch, Limits{1, 4096, "1 to 4096"});
  visit("steps", config.steps, kCount);
  visit("learning_rate", config.learning_rate, Limits{1e-9, 1, "1e-9 to 1"});
  visit("weight_decay", config.weight_decay, kShare);
  visit("warm_up", config.warm_up, Limits{0, 1e9, "0 to 1e9"});
  visit("final_share", config.final_share, kShare);
  visit("average_decay", config.average_decay, Limits{0, 0.999999, "0 to 0.999999"});
  visit("largest_gradient", config.largest_gradient, Limits{1e-6, 1e6, "1e-6 to 1e6"});
  visit("seed", config.seed, kAny);
  visit("validate_every", config.validate_every, kCount);
  visit("validation_samples", config.validation_samples, Limits{1, 1e6, "1 to 1e6"});
  visit("save_every", config.save_every, kCount);
  visit("mirror", config.augment.mirror, kAny);
  visit("colour_deviation", config.augment.colour_deviation, kShare);
  visit("exposure_deviation", config.augment.exposure_deviation, Limits{0, 2, "0 to 2"});
  visit("grey_share", config.augment.grey_share, kShare);
  visit("no_mask_share", config.augment.no_mask_share, kShare);
  visit("occluder_share", config.augment.occluder_share, kShare);
  visit("zoom_share", config.augment.zoom_share, kShare);
  visit("close_share", config.augment.close_share, kShare);
  visit("cut_share", config.augment.cut_share, kShare);
  visit("loss_encoded", config.loss.encoded, kWeight);
  visit("loss_gradient", config.loss.gradient, kWeight);
  visit("loss_rms", config.loss.rms, kWeight);
  visit("loss_similarity", config.loss.similarity, kWeight);
  visit("loss_elsewhere", config.loss.elsewhere, kShare);
  visit("loss_normal", config.loss.normal, kWeight);
  visit("loss_spread", config.loss.spread, kWeight);
  visit("loss_depth", config.loss.depth, kWeight);
  visit("loss_region", config.loss.region, kWeight);
  visit("loss_rare", config.loss.rare, kWeight);
  visit("loss_shading", config.loss.shading, kWeight);
  visit("loss_colour", config.loss.colour, kWeight);
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::kUsage, "The training config " + what); }

std::string known_keys() {
  const TrainConfig config;
  std::string keys = "network";
  each_field(config, [&](const char* key, const auto&, const Limits&) { keys += std::string(", ") + key; });
  return keys;
}

std::string outside(const char* name, double value, const char* allowed) {
  return "The training config's " + std::string(name) + " is " + Json(value).dump() + "; allowed is " + allowed + ".";
}

}  // namespace

std::string TrainConfig::validate() const {
  std::string problem;
  each_field(*this, [&](const char* key, const auto& value, const Limits& limits) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      const auto number = static_cast<double>(value);
      if (problem.empty() && limits.allowed != nullptr && !(number >= limits.low && number <= limits.high))
        problem = outside(key, number, limits.allowed);
    }
  });
  if (!problem.empty()) return problem;
  if (architecture != "unet" && architecture != "face" && architecture != "mscr" && architecture != "shi") {
    return "The training config's architecture is \"" + architecture + "\"; there are unet, face, mscr and shi.";
  }
  if (picture_px != 0 && (picture_px < 8 || architecture != "face")) {
    return "The training config's picture_px is " + std::to_string(picture_px) + " for the architecture \"" +
           architecture + "\"; allowed is 0, and for face 8 to 1024.";
  }
  return {};
}

TrainConfig train_config_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("is not a JSON object.");
  TrainConfig config;
  std::size_t found = 0;
  each_field(config, [&](const char* key, auto& value, const Limits&) {
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
      each_field(config, [&](const char* name, const auto&, const Limits&) { known = known || key == name; });
      if (!known) refuse("has the key \"" + key + "\"; there are: " + known_keys() + ".");
    }
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

std::string to_json(const TrainConfig& config) {
  Json json;
  each_field(config, [&](const char* key, const auto& value, const Limits&) { json[key] = value; });
  json["network"] = Json::parse(config.network);
  return json.dump(1);
}

}  // namespace faceprobe::train
