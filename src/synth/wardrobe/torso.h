#pragma once
// What is worn below the chin: a garment from the collar to the chest.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/skin_field.h"

namespace faceprobe::synth {

// `skin` holds the skin only. Returns one mesh.
SurfaceMesh make_torso(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& skin);

// A point of the body that garments are made for, `room_m` over it. `station`: 0 = collar .. 7 = chest, below 0 up the neck;
// azimuth 0 = front, towards +x.
Eigen::Vector3f body_at(const Anatomy& anatomy, float station, float azimuth, float room_m);

}  // namespace faceprobe::synth
