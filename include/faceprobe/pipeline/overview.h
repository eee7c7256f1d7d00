#pragma once
// One picture to look at: the photo with the face's mesh, the layers, the environment map with its main lights, the confidence, and
// a diffuse, a matte and a mirror ball under the estimated light, captioned.
//
//   io::write_picture("overview.png", draw_overview(estimate, photo, estimate.largest));

#include "faceprobe/core/image.h"
#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

// 1600 px wide sRGB picture of one face's estimate; throws std::out_of_range unless index < estimate.faces.size().
ByteImage draw_overview(const Estimate& estimate, const io::Photo& photo, std::size_t index, int threads = 0);

}  // namespace faceprobe::pipeline
