#pragma once
// A head for tests: an ellipsoid with a nose, on a cylinder for a neck, with 68 landmarks on it. Mirror-symmetrical. Its skull is
// known in closed form.

#include "faceprobe/synth/wardrobe.h"

namespace faceprobe::synth {

inline const Eigen::Vector3f kEggCentre(0.0F, 0.0F, -0.085F);
inline const Eigen::Vector3f kEggRadii(0.078F, 0.115F, 0.100F);

Head egg_head(bool landmarks = true);
// Below 1 inside the skull, above outside.
float egg_level(const Eigen::Vector3f& p);

}  // namespace faceprobe::synth
