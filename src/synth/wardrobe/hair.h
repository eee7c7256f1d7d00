#pragma once
// A head of hair: strands and the dark under them.

#include "synth/wardrobe/hair_guides.h"
#include "synth/wardrobe/headwear.h"

namespace faceprobe::synth {

// Adds to `out`. `field` holds the skin and the clothes below; `hat` may be empty.
void add_hair(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, const HatShell& hat,
              Figure& out);

// How strands of hair answer light.
Reflectance hair_reflectance(const Eigen::Vector3f& colour);

}  // namespace faceprobe::synth
