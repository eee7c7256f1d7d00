#pragma once
// Internal: which people finetuning learns from and which it is measured on, and groups of a person's photos.
//
//   const SplitPeople people = split_people(run.people, config.seed, config.held_out_share);
//   const std::vector<int> chosen = drawn_photos(person, config.photos, random);
//   const std::optional<PersonPhotos> group = group_of(person, chosen, person_loss_options(config));

#include "faceprobe/core/random.h"
#include "faceprobe/train/finetune.h"
#include "train/person_loss.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace faceprobe::train {

struct SplitPeople {
  std::vector<const PersonSet*> trained, held_out;
};
// By seed and name, so that a person is on the same side whoever else there is. Throws Error(kInput) when a side is empty.
SplitPeople split_people(const std::vector<PersonSet>& people, std::uint64_t seed, double held_out_share);

PersonLossOptions person_loss_options(const FinetuneConfig& config);

// Numbers of `count` different photos of a person; of all of them when there are fewer.
std::vector<int> drawn_photos(const PersonSet& person, int count, Random random);
// Nothing when the photos show too little skin in common.
std::optional<PersonPhotos> group_of(const PersonSet& person, const std::vector<int>& chosen,
                                     const PersonLossOptions& options);

}  // namespace faceprobe::train
