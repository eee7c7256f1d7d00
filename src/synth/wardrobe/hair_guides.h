#pragma once
// Guide hairs: few, grown step by step under the comb, gravity and the head in their way. Strands follow them.

#include "synth/wardrobe/hair_style.h"
#include "synth/wardrobe/skin_field.h"

#include <vector>

namespace faceprobe::synth {

struct Guide {
  Eigen::Vector3f root;
  int side = 0;
  std::vector<Eigen::Vector3f> points;   // evenly along its length, from the root
  std::vector<Eigen::Vector3f> normals;  // away from the head
};

inline constexpr int kGuidePoints = 36;

Guide grow(const HairStyle& style, const Anatomy& anatomy, const SkinField& field, const Scalp::Root& root,
           Random& random);

}  // namespace faceprobe::synth
