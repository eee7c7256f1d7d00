#include "eval/photo_choice.h"

#include "eval/small_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace faceprobe::eval {
namespace {

// As shards are read: one person after the other.
std::vector<int> people_of(int photos, int each) {
  std::vector<int> people;
  for (int i = 0; i < photos; ++i) people.push_back(i / each);
  return people;
}

std::map<int, int> counts(const std::vector<int>& chosen, const std::function<int(int)>& label) {
  std::map<int, int> out;
  for (const int number : chosen) ++out[label(number)];
  return out;
}

int most(const std::map<int, int>& counted) {
  return std::ranges::max_element(counted, {}, &std::pair<const int, int>::second)->second;
}
int least(const std::map<int, int>& counted) {
  return std::ranges::min_element(counted, {}, &std::pair<const int, int>::second)->second;
}

// The set that light is measured on: four photos a person, of as many skins.
TEST(PhotoChoice, AHundredOfFourHundredAreAHundredPeopleOfAllSkins) {
  const std::vector<int> people = people_of(400, 4);
  const std::vector<int> chosen = spread_over_people(people, 100);
  EXPECT_EQ(counts(chosen, [&](int n) { return people[static_cast<std::size_t>(n)]; }).size(), 100U);
  EXPECT_EQ(counts(chosen, [](int n) { return n % 4; }), (std::map<int, int>{{0, 25}, {1, 25}, {2, 25}, {3, 25}}));
  // Half as many are every other person, skins still in turns.
  const std::vector<int> half = spread_over_people(people, 50);
  EXPECT_EQ(counts(half, [](int n) { return n / 8; }).size(), 50U);
  EXPECT_EQ(least(counts(half, [](int n) { return n % 4; })), 12);
}

// Faces of 4 views x 16 lights a person, the last person's cut off: 31 people with 64 photos and one with 16.
TEST(PhotoChoice, OfManyPhotosAPersonAllPeopleHaveTheirShare) {
  const std::vector<int> people = people_of(2000, 64);
  const std::vector<int> chosen = spread_over_people(people, 100);
  const std::map<int, int> of_person = counts(chosen, [](int n) { return n / 64; });
  EXPECT_EQ(of_person.size(), 32U);
  EXPECT_EQ(least(of_person), 3);
  EXPECT_EQ(most(of_person), 4);
  EXPECT_EQ(least(counts(chosen, [](int n) { return n % 4; })), 25);
  // Views, of which the cut-off person has one, and lights: none is left out, none is half of all.
  const std::map<int, int> of_view = counts(chosen, [](int n) { return n % 64 / 16; });
  EXPECT_EQ(of_view.size(), 4U);
  EXPECT_LT(most(of_view), 35);
  EXPECT_EQ(counts(chosen, [](int n) { return n % 16; }).size(), 16U);
}

TEST(PhotoChoice, EachPhotoIsTakenOnceAndInOrder) {
  for (const int each : {1, 2, 3, 4, 5, 6, 12, 64}) {
    const std::vector<int> people = people_of(100, each);
    for (const int count : {1, 7, 50, 99, 100, 1000}) {
      const std::vector<int> chosen = spread_over_people(people, count);
      EXPECT_EQ(chosen.size(), static_cast<std::size_t>(std::min(count, 100))) << each << " a person";
      EXPECT_TRUE(std::ranges::is_sorted(chosen));
      EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), chosen.size()) << each << " a person";
    }
  }
}

TEST(PhotoChoice, WhoHasFewPhotosGivesThemAllAndOthersTheRest) {
  const std::vector<int> people = {7, 7, 7, 7, 7, 7, 2, 9, 9};
  const std::vector<int> chosen = spread_over_people(people, 7);
  const std::map<int, int> of_person = counts(chosen, [&](int n) { return people[static_cast<std::size_t>(n)]; });
  EXPECT_EQ(of_person, (std::map<int, int>{{2, 1}, {7, 4}, {9, 2}}));
  EXPECT_TRUE(spread_over_people({}, 5).empty());
  EXPECT_TRUE(spread_over_people(people, 0).empty());
}

TEST(PhotoChoice, ShardsArePeople) {
  const SmallFaces small;
  const synth::ShardReader faces(small.path());
  EXPECT_EQ(person_key(faces, 0), person_key(faces, 2));
  EXPECT_EQ(chosen_by_person(faces, 3), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(chosen_by_person(faces, 1).size(), 1U);
}

}  // namespace
}  // namespace faceprobe::eval
