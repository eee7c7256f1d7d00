#include "faceprobe/synth/recipe.h"

#include "synth/generate/group.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace faceprobe::synth {
namespace {

constexpr int kMostLamps = 8;
constexpr double kLeastLampDistance = 0.6, kMostLampDistance = 20;  // metres

std::string out_of_range(const char* name, long long value, long long low, long long high) {
  return std::string(name) + " is " + std::to_string(value) + "; allowed is " + std::to_string(low) + " to " +
         std::to_string(high) + ".";
}

// What is asked of groups.
std::string group_fault(const Recipe& recipe) {
  const bool asked = recipe.people || recipe.lamps || recipe.lamp_distance_m;
  if (asked && !recipe.multi_face) return "People, lamps and their distance are asked of groups; add multi-face.";
  if (recipe.people && (*recipe.people < kFewestPeople || *recipe.people > kMostPeople))
    return out_of_range("people", *recipe.people, kFewestPeople, kMostPeople);
  if (recipe.lamps && (*recipe.lamps < 0 || *recipe.lamps > kMostLamps))
    return out_of_range("lamps", *recipe.lamps, 0, kMostLamps);
  if (!recipe.lamp_distance_m) return {};
  const auto [low, high] = *recipe.lamp_distance_m;
  if (!(low >= kLeastLampDistance && low < high && high <= kMostLampDistance)) {
    std::ostringstream text;
    text << "lamp distance is " << low << " to " << high << " m; allowed is from a lower to a higher one within "
         << kLeastLampDistance << " to " << kMostLampDistance << ".";
    return text.str();
  }
  if (recipe.lamps == 0) return "A distance is asked of lamps, and there are 0; leave one of them out.";
  return {};
}

const char* name_of(Mode mode) { return mode == Mode::kPaper ? "paper" : "default"; }

const char* name_of(Split split) {
  switch (split) {
    case Split::kTrain: return "train";
    case Split::kDev: return "dev";
    case Split::kAll: break;
  }
  return "all";
}

}  // namespace

std::string Recipe::validate() const {
  struct Limit {
    const char* name;
    long long value, low, high;
  };
  const Limit limits[] = {
      {"count", count, 1, 100'000'000},
      {"size", size_px, 32, 1024},
      {"views per person", views_per_person, 1, 1024},
      {"samples per view", samples_per_view, 1, 4096},
      {"skins per person", skins_per_person, 1, 64},
      {"samples per side", samples_per_side, 1, 8},
      {"nside", nside, 4, 32},
      {"bounce rays", bounce_rays, 0, 4096},
      {"environment height", environment_height, 4, 512},
  };
  for (const Limit& limit : limits) {
    if (limit.value < limit.low || limit.value > limit.high) {
      return out_of_range(limit.name, limit.value, limit.low, limit.high);
    }
  }
  constexpr int kLeastGroupPx = 192;  // below, a face of four has fewer than 40 px
  if (multi_face && size_px < kLeastGroupPx) {
    return "size is " + std::to_string(size_px) + ", too small for several faces; allowed is " +
           std::to_string(kLeastGroupPx) + " to 1024.";
  }
  if (multi_face && mode == Mode::kPaper) return "the paper's mode has one face to a picture; leave out multi-face.";
  return group_fault(*this);
}

std::string to_json(const Recipe& recipe) {
  nlohmann::ordered_json json = {
      {"count", recipe.count},
      {"size_px", recipe.size_px},
      {"seed", recipe.seed},
      {"mode", name_of(recipe.mode)},
      {"split", name_of(recipe.split)},
      {"multi_face", recipe.multi_face},
      {"views_per_person", recipe.views_per_person},
      {"samples_per_view", recipe.samples_per_view},
      {"skins_per_person", recipe.skins_per_person},
      {"samples_per_side", recipe.samples_per_side},
      {"nside", recipe.nside},
      {"bounce_rays", recipe.bounce_rays},
      {"environment_height", recipe.environment_height},
  };
  // Recipes without them read as before there were any, so that older data sets are known again.
  if (recipe.people) json["people"] = *recipe.people;
  if (recipe.lamps) json["lamps"] = *recipe.lamps;
  if (recipe.lamp_distance_m) json["lamp_distance_m"] = *recipe.lamp_distance_m;
  return json.dump();
}

}  // namespace faceprobe::synth
