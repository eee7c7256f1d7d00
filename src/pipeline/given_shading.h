#pragma once
// Shading by somebody else's split of the diffuse layer.

#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

// `diffuse`: crop x 3; `skin`: crop x 1, non-zero on skin; `clipped`: io::Photo bits in the crop. The split sees a copy as small as the network's;
// its answer, crop x 3, is enlarged and brought to the level at which the skin's albedo, mean by the light on it, has the luminance kSkinLuminance,
// which is assumed elsewhere too. Nowhere under a hundredth of its mean on the skin, so that it can be divided by. Throws std::invalid_argument when
// the answer has another size than what the split was given.
Image given_shading(const ShadingSplit& split, const Image& diffuse, const ByteImage& skin, const ByteImage& clipped,
                    int threads);

}  // namespace faceprobe::pipeline
