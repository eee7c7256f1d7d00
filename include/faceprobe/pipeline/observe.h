#pragma once
// The step from pictures to rows: averages the layers and the geometry of a face over small square patches of skin.
//
//   const lighting::Observations rows = observe(geometry, layers.highlight, shading, flags, 1000, 0);

#include "faceprobe/core/image.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/lighting/observations.h"

namespace faceprobe::pipeline {

// `highlight` and `shading`: crop x 3; `flags`: io::Photo bits in the crop. At most about `max_patches` rows, horizons
// included; none where no skin can be used. `open_shading`: crop x 3, or empty where it is not known. Throws std::invalid_argument for pictures of
// other sizes or channels and for no patches.
lighting::Observations observe(const face::FaceGeometry& geometry, const Image& highlight, const Image& shading,
                               const ByteImage& flags, int max_patches, int threads, const Image& open_shading = {});

// `region` (face::FaceGeometry) where it is skin, 0 elsewhere: crop x 1.
ByteImage skin_regions(const ByteImage& region);

}  // namespace faceprobe::pipeline
