#include "faceprobe/lighting/recolour.h"

#include <algorithm>

namespace faceprobe::lighting {

Eigen::MatrixX3f recolour_highlights(const Observations& observations) {
  // Under very warm light the blue of the shading goes to zero and the ratio of Eq. 6 explodes; below a tenth of the mean of the
  // three channels it carries no information.
  constexpr float kLeastShare = 0.1F;
  Eigen::MatrixX3f recoloured = observations.highlight;
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    if (!observations.clipped.row(i).any()) continue;
    Eigen::RowVector3f shading = observations.shading.row(i);
    if (!(shading.maxCoeff() > 0)) continue;
    shading = shading.cwiseMax(kLeastShare * shading.mean());
    int reference = 2;
    for (const int channel : {2, 1, 0}) {
      if (!observations.clipped(i, channel)) {
        reference = channel;
        break;
      }
    }
    // Channels that are not clipped are right as they are; with everything clipped, blue stands for all (section 4.3).
    for (int channel = 0; channel < 3; ++channel) {
      if (!observations.clipped(i, channel) || channel == reference) continue;
      const float rescaled = observations.highlight(i, reference) * shading[channel] / shading[reference];
      recoloured(i, channel) = std::max(observations.highlight(i, channel), rescaled);
    }
  }
  return recoloured;
}

}  // namespace faceprobe::lighting
