#pragma once
// Glasses: two lenses in their frames, a bridge over the nose, bars back to the ears.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/skin_field.h"

namespace faceprobe::synth {

void add_glasses(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, Figure& out);

}  // namespace faceprobe::synth
