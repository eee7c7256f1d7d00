#pragma once
// Layers of an estimate in the mesh's own square, so that pictures of one person can be compared pixel by pixel.

#include "faceprobe/pipeline/estimate.h"
#include "train/frontalise.h"

namespace faceprobe::bench {

// Of the square that takes the face's crop. Crops of more than twice the square's size alias.
train::Warp warp_of(const pipeline::FaceEstimate& estimate, const train::FaceTemplate& square);

}  // namespace faceprobe::bench
