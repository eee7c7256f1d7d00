#include "faceprobe/lighting/recolour.h"

namespace faceprobe::lighting {

Eigen::MatrixX3f recolour_highlights(const Observations& observations) {
  // Under very warm light the blue of the shading goes to zero and the ratio of Eq. 6 explodes; below a tenth of the mean of the
  // three channels it carries no information.
  constexpr float kLeastShare = 0.1F;
  Eigen::MatrixX3f recoloured = observations.highlight;
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    const Eigen::RowVector3f shading = observations.shading.row(i);
    if (!(shading.maxCoeff() > 0)) continue;
    const Eigen::RowVector3f colour = shading.cwiseMax(kLeastShare * shading.mean());
    int reference = 2;  // also where all are clipped: on skin blue is clipped last
    for (const int channel : {2, 1, 0}) {
      if (!observations.clipped(i, channel)) {
        reference = channel;
        break;
      }
    }
    recoloured.row(i) = observations.highlight(i, reference) / colour[reference] * colour;
  }
  return recoloured;
}

}  // namespace faceprobe::lighting
