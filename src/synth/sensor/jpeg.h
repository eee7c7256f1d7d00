#pragma once
// Internal: jpeg_round_trip on planes of whole code values, one of them (grey) or three.

#include "synth/sensor/planes.h"

namespace faceprobe::synth {

void jpeg_planes(Planes& codes, int quality, bool chroma_half);

}  // namespace faceprobe::synth
