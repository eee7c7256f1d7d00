#pragma once
// What a data set of synthetic faces is made of, apart from the assets: numbers and shares, drawn from one seed.
//
// Work is split by person, or by group: one head, expression and set of clothes, seen in a few views (pose and camera), each view lit by many maps,
// in a few skins. One shard of the data set is one person, so that shards depend on nothing but the seed and their number. A set to measure on
// wants many people rather than many photos of each.
//
//   const Recipe recipe{.count = 20000, .size_px = 128, .seed = 7, .split = Split::kTrain};

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace faceprobe::synth {

enum class Mode : std::uint8_t {
  kDefault,  // photos: hair, glasses, things in front, cameras, real reflectance
  kPaper,  // the ECCV 2018 paper's Section 5.1: bare heads before black, one specular albedo in [0, 1], a perfect camera
};

// Which of the skin textures are used: a development set shows none that training has seen.
enum class Split : std::uint8_t { kAll, kTrain, kDev };

struct Recipe {
  int count = 1000;   // samples
  int size_px = 128;  // 32 .. 1024
  std::uint64_t seed = 1;
  Mode mode = Mode::kDefault;
  Split split = Split::kAll;  // kTrain leaves out every sixth texture, kDev uses only those; identities differ too
  bool multi_face =
      false;  // two to four people to a picture, lit by lamps at known places, for triangulation; from 192 px on
  // Of multi_face alone. None of these changes what else is drawn.
  std::optional<int> people = {};  // in each group, 2 to 4; none = drawn for each
  std::optional<int> lamps = {};  // of each sample, 0 to 8; 0 = the map alone lights it, as it is; none = one to three, drawn
  // Metres of each lamp from every face, low and high, within 0.6 and 20; none = anywhere in the room, 0.55 and its radius at least.
  std::optional<std::array<double, 2>> lamp_distance_m = {};
  int views_per_person = 4;     // of each person, or of each group
  int samples_per_view = 16;    // maps, with their turns
  int skins_per_person = 4;     // textures and tones that take turns over a view's samples
  int samples_per_side = 3;     // primary rays per pixel and side
  int nside = 16;               // cells of light
  int bounce_rays = 48;         // per vertex; 0 = direct light only
  int environment_height = 32;  // of the map that is stored with each sample

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;

  int samples_per_person() const { return views_per_person * samples_per_view; }
  int person_count() const { return (count + samples_per_person() - 1) / samples_per_person(); }
};

// One JSON object with every field; `people`, `lamps` and `lamp_distance_m` where they are given.
std::string to_json(const Recipe& recipe);

}  // namespace faceprobe::synth
