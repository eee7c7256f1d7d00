#pragma once
// Internal: which photos of a data set are measured. Photos of one person share head, clothes and much of their error, so as many people as possible are
// to be among the few that are taken.

#include "faceprobe/synth/shard.h"

#include <string>
#include <vector>

namespace faceprobe::eval {

// Indices into `person_of_photo`, ascending, each once: `count` of them, or all. No person has more than one photo more than another who has
// others left; where there are more people than `count`, those taken are spread evenly. Which of a person's photos are taken changes from person to
// person by a step that meets all of them in turn, so that what follows from a photo's place among the person's own (its skin, its pose)
// is taken in turns too.
std::vector<int> spread_over_people(const std::vector<int>& person_of_photo, int count);

// The same of a data set: numbers of samples.
std::vector<int> chosen_by_person(const synth::ShardReader& faces, int count);

// Evenly over the data set, whoever is shown.
std::vector<int> evenly_chosen(const synth::ShardReader& faces, int count);

// Whom a sample shows, or which group of people: the number of its shard, which holds nobody else.
std::string person_key(const synth::ShardReader& faces, int number);

}  // namespace faceprobe::eval
