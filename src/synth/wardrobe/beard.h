#pragma once
// Short hair on the face: beard, moustache, lashes.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/skin_field.h"

namespace faceprobe::synth {

void add_beard(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, Figure& out);
void add_lashes(const WardrobeSettings& settings, const Anatomy& anatomy, Figure& out);

}  // namespace faceprobe::synth
