#include "train/finetune_people.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/permutation.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

namespace faceprobe::train {
namespace {

constexpr Eigen::Index kLeastSkin = 200;  // pixels of the square that a group of photos must share

}  // namespace

SplitPeople split_people(const std::vector<PersonSet>& people, std::uint64_t seed, double held_out_share) {
  SplitPeople split;
  for (const PersonSet& person : people) {
    // By name, so that a person of two folders of that name is on one side.
    const std::string name = person.name.substr(person.name.rfind('/') + 1);
    std::uint64_t key = 0;
    for (const char c : name) key = key * 131 + static_cast<std::uint64_t>(std::tolower(static_cast<unsigned char>(c)));
    const bool held_out = Random({seed, 0x9E0, key}).uniform() < held_out_share;
    (held_out ? split.held_out : split.trained).push_back(&person);
  }
  if (split.trained.empty() || split.held_out.empty()) {
    throw Error(ExitCode::kInput, "Of " + std::to_string(people.size()) + " people with enough photos " +
                                      std::to_string(split.held_out.size()) + " would be held out and " +
                                      std::to_string(split.trained.size()) +
                                      " trained on; give more people, or another held-out share or seed.");
  }
  return split;
}

PersonLossOptions person_loss_options(const FinetuneConfig& config) {
  if (config.mode == "paper") return {.rank1 = false, .blur_sigma_px = 0, .guard_weight = 0, .energy_weight = 0};
  PersonLossOptions options;
  options.energy_weight = config.energy_weight;
  return options;
}

std::vector<int> drawn_photos(const PersonSet& person, int count, Random random) {
  std::vector<int> order = permutation(static_cast<int>(person.photos.size()), random);
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  return order;
}

std::optional<PersonPhotos> group_of(const PersonSet& person, const std::vector<int>& chosen,
                                     const PersonLossOptions& options) {
  std::vector<PersonPhoto> photos;
  for (const int i : chosen) photos.push_back(*person.photos[static_cast<std::size_t>(i)]);
  try {
    PersonPhotos group(std::move(photos), person.regions, options);
    if (group.pixels() >= kLeastSkin) return group;
  } catch (const std::invalid_argument&) {  // no common skin at all
  }
  return std::nullopt;
}

}  // namespace faceprobe::train
