#pragma once
// Things in front of the face: a phone, a hand, a microphone, a cup, a mask.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/skin_field.h"

namespace faceprobe::synth {

class MeshBuilder;

// `field` holds the skin.
void add_held(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, Figure& out);

// A surgical mask from the bridge of the nose to below the chin, with its loops.
void add_mask(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, Figure& out);

// A hand: the palm's middle, where its fingers point and where its back faces. `spread` 0 .. 1, `curl` in radians per joint.
struct HandPose {
  Eigen::Vector3f palm;
  Eigen::Vector3f fingers;
  Eigen::Vector3f back;
  float spread = 0.2F;
  float curl = 0.25F;
  bool left = false;
};
// Fingers are kept `field` outside the skin; null: wherever they are.
void add_hand(const HandPose& pose, float scale, const SkinField* field, MeshBuilder& mesh);

}  // namespace faceprobe::synth
