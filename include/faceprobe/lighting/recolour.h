#pragma once
// Eq. 6 of Yi et al. 2018: a clipped channel holds less highlight than there was. Where some channel is not clipped, the others
// follow from it and the chromaticity of the diffuse shading, which rarely clips and is lit by the same light.
//
//   const Eigen::MatrixX3f highlight = recolour_highlights(observations);

#include "faceprobe/lighting/observations.h"

namespace faceprobe::lighting {

// Recoloured highlights, #patches x 3. The reference channel is blue, else green, else red, whichever is not clipped; blue when all
// are (section 4.3). Patches without any clipped channel keep their own colour.
Eigen::MatrixX3f recolour_highlights(const Observations& observations);

}  // namespace faceprobe::lighting
