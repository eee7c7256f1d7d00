#include "faceprobe/core/error.h"
#include "faceprobe/train/train_sky.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

// Calls visit(key, value, low, high) for every number.
template <class Config, class Visit>
void each_sky_number(Config& config, const Visit& visit) {
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
}

[[noreturn]] void refuse_sky(const std::string& what) { throw Error(ExitCode::kUsage, "The sky config " + what); }

}  // namespace

std::string SkyConfig::validate() const {
  std::string problem;
  each_sky_number(*this, [&](const char* key, const auto& value, double low, double high) {
    const auto number = static_cast<double>(value);
    if (problem.empty() && !(number >= low && number <= high)) {
      problem = "The sky config's " + std::string(key) + " is " + Json(number).dump() + "; allowed is " +
                Json(low).dump() + " to " + Json(high).dump() + ".";
    }
  });
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
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) refuse_sky("is not a JSON object.");
  SkyConfig config;
  std::set<std::string> known = {"widths"};
  const auto read = [&](const char* key, auto& value) {
    if (!json.contains(key)) return;
    try {
      json.at(key).get_to(value);
    } catch (const nlohmann::json::exception&) {
      refuse_sky(std::string("has ") + json.at(key).dump() + " for " + key + ", which is not of its type.");
    }
  };
  read("widths", config.widths);
  each_sky_number(config, [&](const char* key, auto& value, double, double) {
    known.insert(key);
    read(key, value);
  });
  for (const auto& [key, value] : json.items()) {
    if (known.contains(key)) continue;
    std::string keys;
    for (const std::string& name : known) keys += keys.empty() ? name : ", " + name;
    refuse_sky("has the key \"" + key + "\"; there are: " + keys + ".");
  }
  if (const std::string problem = config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return config;
}

std::string to_json(const SkyConfig& config) {
  Json json = {{"widths", config.widths}};
  each_sky_number(config, [&](const char* key, const auto& value, double, double) { json[key] = value; });
  return json.dump(1);
}

}  // namespace faceprobe::train
