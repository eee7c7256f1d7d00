#pragma once
// A haircut in numbers: where hair grows to, how long, how it hangs together. Drawn per person from a cut.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/scalp.h"

namespace faceprobe::synth {

struct HairStyle {
  HairCut cut = HairCut::kShort;
  HairlineShape hairline;
  // Lengths, metres on an average head: on top, at the front of it, over the ears, at the nape.
  float top_m = 0.04F;
  float front_m = 0.04F;
  float side_m = 0.02F;
  float nape_m = 0.012F;
  float fringe_end_m = 0.0F;   // over the brows
  float length_jitter = 0.2F;  // relative
  // Forces on a guide, relative to each other.
  float stiffness = 1.0F;  // keeps its direction
  float flow = 0.6F;       // follows the comb
  float gravity = 0.2F;
  float lift = 0.8F;        // leaves the skin upright
  float lie = 0.2F;         // is pulled back to its layer
  float volume_m = 0.008F;  // of the layers over the skin
  float wander = 0.1F;      // of guides
  // Strands about their guides.
  float clump = 0.6F;  // how far tips come together
  int clump_size = 14;
  float wave_m = 0.0F;  // amplitude
  float wave_length_m = 0.03F;
  bool helix = false;  // waves go round instead of to and fro
  float frizz_m = 0.0008F;
  float flyaway = 0.03F;  // share of strands that go astray
  float radius_m = 0.00034F;
  float strand_share = 1.0F;  // of the strands asked for
  int points = 10;
  float feather_m = 0.012F;  // of the hairline
  // Where the comb goes.
  Eigen::Vector3f comb{0.3F, 0, 1};  // on the top's front
  float part_x = 0.0F;               // metres
  bool parted = false;
  float whorl_side = 1.0F;
  float backward = 0.3F;  // of hair that hangs: behind the ears or beside the face
  Eigen::Vector3f bun{0, 0, -0.1F};
};

HairStyle draw_style(const WardrobeSettings& settings, const Anatomy& anatomy, Random& random);

// Length of a strand by where it grows.
float length_at(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root);
// Direction that hair is combed in at a point, for a strand of this root; not normalised, may be zero.
Eigen::Vector3f flow_at(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root,
                        const Eigen::Vector3f& p, const Eigen::Vector3f& normal);
// -1 or 1: which side of the parting; 0 without one. Hair of one side has nothing to do with the other's.
int side_of(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root);

}  // namespace faceprobe::synth
