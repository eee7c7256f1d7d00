#pragma once
// Which of the ten skin regions each vertex of a head model belongs to, from the neutral shape and its 68 landmarks; eyeballs and the
// inside of the mouth get their own. Without landmarks all skin is Region::kOther.
//
//   model.vertex_region = regions_from_landmarks(model);

#include "faceprobe/synth/head_model.h"

#include <vector>

namespace faceprobe::synth {

// One Region per vertex. Uses neutral, triangles, triangle_material and landmarks of the model.
std::vector<Region> regions_from_landmarks(const HeadModel& model);

}  // namespace faceprobe::synth
