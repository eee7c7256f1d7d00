#pragma once
// Makes a picture whole where it is known only in part.

#include "faceprobe/core/image.h"

namespace faceprobe::pipeline {

// `picture`: H x W x C; `weight`: H x W x 1, 0 = unknown .. 1 = known. Where the weight is below 1 the rest comes from around, the
// farther away the broader the mean: push-pull (Gortler et al. 1996, "The Lumigraph", section 3.4). All unknown: left as it is.
Image push_pull(const Image& picture, const Image& weight);

}  // namespace faceprobe::pipeline
