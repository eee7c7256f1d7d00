#pragma once
// A head of our own that needs no file: a mannequin of smooth bumps, for tests, demos and a first try. Not for training: its people
// differ in eight ways only, and none has wrinkles.
//
//   const HeadModel model = procedural_head();

#include "faceprobe/synth/head_model.h"

namespace faceprobe::synth {

// About 6,600 vertices with skin, eyeballs, the inside of the mouth and teeth; 8 identity modes; 6 expressions under ARKit's names;
// 68 landmarks; UVs of its own with a small texture.
HeadModel procedural_head();

}  // namespace faceprobe::synth
