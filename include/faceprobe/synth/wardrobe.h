#pragma once
// What people have on and around their faces: hair of many cuts, beards, glasses, hats, scarves, clothes, and things or hands held in
// front. All of it geometry, so it shades the skin the way it does in life.
//
//   const WardrobeSettings settings = draw_wardrobe(random);
//   const Figure clothes = dress(head, settings);

#include "faceprobe/core/random.h"
#include "faceprobe/synth/head_model.h"

namespace faceprobe::synth {

// Hair, headwear, glasses, and what is held before the face.
enum class HairCut : std::uint8_t { kBald, kBuzz, kShort, kParted, kFringe, kLong, kCurly, kTied };
enum class Headwear : std::uint8_t { kNone, kBeanie, kCap, kScarf };
enum class Glasses : std::uint8_t { kNone, kRound, kSquare, kSun };
enum class Held : std::uint8_t { kNone, kPhone, kHand, kMicrophone, kCup, kMask };

struct WardrobeSettings {
  HairCut cut = HairCut::kShort;
  Eigen::Vector3f hair_colour{0.03F, 0.02F, 0.015F};  // linear
  float beard = 0.0F;                                 // 0 none .. 1 full
  float moustache = 0.0F;                             // 0 none .. 1 full
  Headwear headwear = Headwear::kNone;
  Glasses glasses = Glasses::kNone;
  Held held = Held::kNone;
  Eigen::Vector3f skin_tone{0.4F, 0.25F, 0.18F};  // for hands, linear
  int strands = 9000;                             // of a full head of hair
  std::uint64_t seed = 0;                         // of everything else: colours, sizes, strands
};
// As people come: shares are in the source.
WardrobeSettings draw_wardrobe(Random& random);

// Meshes and strands to add to the head's figure, in the head frame. The torso's clothes are always among them.
Figure dress(const Head& head, const WardrobeSettings& settings);

}  // namespace faceprobe::synth
