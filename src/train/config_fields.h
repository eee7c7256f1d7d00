#pragma once
// Internal: configs as JSON. One visitor names each field once, with the limits of what is a number, so that checking, reading and writing
// cannot differ:
//
//   constexpr auto kEachField = [](auto& config, const auto& visit) {
//     visit("hidden", config.hidden);
//     visit("batch", config.batch, 1, 4096);
//   };
//   const auto config = fields_from_json("light", text, LightConfig(), kEachField);

#include "faceprobe/core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace faceprobe::train {

// As it would be written in a config: 4096, 0.95, 1e-9.
inline std::string short_number(double number) {
  constexpr int kDigits = 6;
  std::array<char, 32> room{};
  const std::to_chars_result end =
      std::to_chars(room.data(), room.data() + room.size(), number, std::chars_format::general, kDigits);
  const std::string text(room.data(), end.ptr);
  const std::size_t e = text.find('e');
  return e == std::string::npos ? text : text.substr(0, e + 1) + std::to_string(std::stoi(text.substr(e + 1)));
}

// The first number that is out of its limits as a sentence; empty when all are within. `name`: of the config, in sentences.
template <class Config, class EachField>
std::string limits_problem(const std::string& name, const Config& config, const EachField& each_field) {
  std::string problem;
  each_field(config, [&](const char* key, const auto& value, double low = -HUGE_VAL, double high = HUGE_VAL) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>) {
      const auto number = static_cast<double>(value);
      if (!problem.empty() || (number >= low && number <= high)) return;
      problem = "The " + name + " config's " + key + " is " + nlohmann::ordered_json(value).dump() + "; allowed is " +
                short_number(low) + " to " + short_number(high) + ".";
    }
  });
  return problem;
}

// What the text does not name stays as in `config`. Throws Error(kUsage): not JSON, a key that does not exist, a value of another type, a
// config that does not validate.
template <class Config, class EachField>
Config fields_from_json(const std::string& name, const std::string& text, Config config, const EachField& each_field) {
  const auto refuse = [&](const std::string& what) { throw Error(ExitCode::kUsage, "The " + name + " config " + what); };
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) refuse("is not a JSON object.");
  std::vector<std::string> known;
  each_field(config, [&](const char* key, auto&& value, double = 0, double = 0) {
    known.emplace_back(key);
    if (!json.contains(key)) return;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  });
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(known, key) != known.end()) continue;
    std::string keys;
    for (const std::string& one : known) keys += keys.empty() ? one : ", " + one;
    refuse("has the key \"" + key + "\"; there are: " + keys + ".");
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

template <class Config, class EachField>
std::string fields_to_json(const Config& config, const EachField& each_field) {
  nlohmann::ordered_json json;
  each_field(config, [&](const char* key, const auto& value, double = 0, double = 0) { json[key] = value; });
  return json.dump(1);
}

}  // namespace faceprobe::train
