#include "eval/photo_choice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>

namespace faceprobe::eval {
namespace {

// Nearest to the golden section of `count` that has no divisor in common with it: its multiples meet all of 0 .. count - 1, far apart.
std::size_t golden_step(std::size_t count) {
  constexpr double kGolden = 0.6180339887498949;
  auto step = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kGolden * static_cast<double>(count))));
  while (std::gcd(step, count) != 1) ++step;  // ends: count + 1 has none
  return step;
}

// How many photos of each person are taken.
std::vector<std::size_t> shares(const std::vector<std::vector<int>>& people, std::size_t count) {
  std::vector<std::size_t> taken(people.size(), 0);
  while (count > 0) {
    std::vector<std::size_t> open;  // who has others left
    for (std::size_t p = 0; p < people.size(); ++p) {
      if (taken[p] < people[p].size()) open.push_back(p);
    }
    if (open.empty()) break;
    const std::size_t now = std::min(count, open.size());
    for (std::size_t i = 0; i < now; ++i) ++taken[open[i * open.size() / now]];
    count -= now;
  }
  return taken;
}

}  // namespace

std::vector<int> spread_over_people(const std::vector<int>& person_of_photo, int count) {
  std::map<int, std::vector<int>> by_number;
  for (std::size_t i = 0; i < person_of_photo.size(); ++i) by_number[person_of_photo[i]].push_back(static_cast<int>(i));
  std::vector<std::vector<int>> people;
  for (auto& [person, photos] : by_number) people.push_back(std::move(photos));
  const std::vector<std::size_t> taken = shares(people, static_cast<std::size_t>(std::max(0, count)));
  std::vector<int> chosen;
  std::size_t turn = 0;  // goes on from person to person
  for (std::size_t p = 0; p < people.size(); ++p) {
    const std::size_t step = golden_step(people[p].size());
    for (std::size_t i = 0; i < taken[p]; ++i) chosen.push_back(people[p][turn++ * step % people[p].size()]);
  }
  std::ranges::sort(chosen);
  return chosen;
}

std::vector<int> chosen_by_person(const synth::ShardReader& faces, int count) {
  std::vector<int> person_of_photo;
  person_of_photo.reserve(static_cast<std::size_t>(faces.sample_count()));
  for (int i = 0; i < faces.sample_count(); ++i) person_of_photo.push_back(faces.view_place(i).first);
  return spread_over_people(person_of_photo, count);
}

std::vector<int> evenly_chosen(const synth::ShardReader& faces, int count) {
  std::vector<int> numbers;
  numbers.reserve(static_cast<std::size_t>(count));
  const int taken = std::min(count, faces.sample_count());
  for (int i = 0; i < taken; ++i)
    numbers.push_back(static_cast<int>((static_cast<long long>(i) * faces.sample_count()) / taken));
  return numbers;
}

std::string person_key(const synth::ShardReader& faces, int number) {
  return std::to_string(faces.view_place(number).first);
}

}  // namespace faceprobe::eval
