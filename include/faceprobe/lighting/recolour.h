#pragma once
// Eq. 6 of Yi et al. 2018 (section 4.3): a clipped channel holds less highlight than there was, and a highlight's colour is less certain than its
// strength. So one channel that is not clipped says how strong it is, and the diffuse shading, which rarely clips and is lit by the same light,
// what colour it has. A small lamp of another colour than all the rest gets theirs: the transport solver does not recolour.
//
//   const Eigen::MatrixX3f highlight = recolour_highlights(observations);

#include "faceprobe/lighting/observations.h"

namespace faceprobe::lighting {

// Recoloured highlights, #patches x 3, each of its patch's shading's colour. The reference channel is blue, else green, else red, whichever is not
// clipped; blue when all are. Patches without shading keep their own colour.
Eigen::MatrixX3f recolour_highlights(const Observations& observations);

}  // namespace faceprobe::lighting
