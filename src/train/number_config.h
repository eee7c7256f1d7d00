#pragma once
// Internal: configs that are numbers with limits and one list of sizes. One visitor names each number once, so that checking, reading and
// writing cannot differ:
//
//   constexpr auto kEachNumber = [](auto& config, const auto& visit) { visit("batch", config.batch, 1, 4096); ... };
//   const NumberConfig<LightConfig> kForm{"light", "hidden", &LightConfig::hidden};

#include "faceprobe/core/error.h"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::train {

template <class Config>
struct NumberConfig {
  const char* name;  // of the config, in sentences
  const char* list_key;
  std::vector<int> Config::*list;
};

// The first number that is out of its limits as a sentence; empty when all are within.
template <class Config, class EachNumber>
std::string number_problem(const NumberConfig<Config>& form, const Config& config, const EachNumber& each_number) {
  using Json = nlohmann::ordered_json;
  std::string problem;
  each_number(config, [&](const char* key, const auto& value, double low, double high) {
    const auto number = static_cast<double>(value);
    if (problem.empty() && !(number >= low && number <= high)) {
      problem = "The " + std::string(form.name) + " config's " + key + " is " + Json(number).dump() + "; allowed is " +
                Json(low).dump() + " to " + Json(high).dump() + ".";
    }
  });
  return problem;
}

// What the text does not name stays as in `config`. Throws Error(kUsage): not JSON, a key that does not exist, a value of another type, a
// config that does not validate.
template <class Config, class EachNumber>
Config numbers_from_json(const NumberConfig<Config>& form, const std::string& text, Config config,
                         const EachNumber& each_number) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitCode::kUsage, "The " + std::string(form.name) + " config " + what);
  };
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("is not a JSON object.");
  std::set<std::string> known;
  const auto read = [&](const char* key, auto& value) {
    known.insert(key);
    if (!json.contains(key)) return;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  };
  read(form.list_key, config.*form.list);
  each_number(config, [&](const char* key, auto& value, double, double) { read(key, value); });
  for (const auto& [key, value] : json.items()) {
    if (known.contains(key)) continue;
    std::string keys;
    for (const std::string& name : known) keys += keys.empty() ? name : ", " + name;
    refuse("has the key \"" + key + "\"; there are: " + keys + ".");
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

template <class Config, class EachNumber>
std::string numbers_to_json(const NumberConfig<Config>& form, const Config& config, const EachNumber& each_number) {
  nlohmann::ordered_json json = {{form.list_key, config.*form.list}};
  each_number(config, [&](const char* key, const auto& value, double, double) { json[key] = value; });
  return json.dump(1);
}

}  // namespace faceprobe::train
