#include "faceprobe/core/error.h"
#include "faceprobe/train/train_light.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

// Calls visit(key, value, low, high) for every number.
template <class Config, class Visit>
void each_number(Config& config, const Visit& visit) {
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
  visit("seed", config.seed, 0, 1e18);
}

[[noreturn]] void refuse(const std::string& what) { throw Error(ExitCode::kUsage, "The light config " + what); }

}  // namespace

std::string LightConfig::validate() const {
  std::string problem;
  each_number(*this, [&](const char* key, const auto& value, double low, double high) {
    const auto number = static_cast<double>(value);
    if (problem.empty() && !(number >= low && number <= high)) {
      problem = "The light config's " + std::string(key) + " is " + Json(number).dump() + "; allowed is " +
                Json(low).dump() + " to " + Json(high).dump() + ".";
    }
  });
  const bool sizes = std::ranges::all_of(hidden, [](int size) { return size >= 1 && size <= 16384; });
  if (problem.empty() && (hidden.empty() || hidden.size() > 8 || !sizes))
    problem = "The light config's hidden must list 1 to 8 sizes of 1 to 16384.";
  return problem;
}

LightConfig light_config_from_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("is not a JSON object.");
  LightConfig config;
  std::set<std::string> known = {"hidden"};
  const auto read = [&](const char* key, auto& value) {
    if (!json.contains(key)) return;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  };
  read("hidden", config.hidden);
  each_number(config, [&](const char* key, auto& value, double, double) {
    known.insert(key);
    read(key, value);
  });
  for (const auto& [key, value] : json.items()) {
    if (known.contains(key)) continue;
    std::string keys;
    for (const std::string& name : known) keys += keys.empty() ? name : ", " + name;
    refuse("has the key \"" + key + "\"; there are: " + keys + ".");
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

std::string to_json(const LightConfig& config) {
  Json json = {{"hidden", config.hidden}};
  each_number(config, [&](const char* key, const auto& value, double, double) { json[key] = value; });
  return json.dump(1);
}

}  // namespace faceprobe::train
