#pragma once
// Internal: the shading that a face would have if nothing stood between its skin and the light: no brow, no hair, no shoulders, and no light
// that these send back. Of the shading that is there it cannot be computed, but a network can learn what a shadow under a chin says of the lamp.
//
//   const Image open = open_shading(sample.environment, view.normal, view.region);

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"

namespace faceprobe::train {

// Irradiance / pi of a distant light at each normal, three channels, on the map's scale; 0 off the face's skin and eyes, and where the light is
// none. By harmonics of order 4 (Ramamoorthi & Hanrahan 2001): within 6 % of the largest that a lamp gives. `normal` and `region` are of one size, the normals
// in the map's frame.
Image open_shading(const EnvMap& environment, const Image& normal, const ByteImage& region);

}  // namespace faceprobe::train
