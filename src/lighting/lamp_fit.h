#pragma once
// Internal: one lamp that explains lights which several faces see, near or distant, by weighted least squares.

#include "faceprobe/lighting/triangulate.h"

namespace faceprobe::lighting {

struct LampFit {
  bool near = false;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // of a near one
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // of a distant one
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  double cost =
      0;  // twice the negative logarithm of the likelihood, up to a constant: of directions, and of strengths about their mean

  // Unit vector towards the lamp.
  Eigen::Vector3d seen_from(const Eigen::Vector3d& place_m) const {
    return near ? (position_m - place_m).normalized() : direction;
  }
};

// `seen`: at least two, of different faces. A face's own place is uncertain, which counts as an error of direction that shrinks with distance.
LampFit fit_near_lamp(const std::vector<FaceLights>& faces, const std::vector<Sighting>& seen,
                      const TriangulateOptions& options);
LampFit fit_distant_lamp(const std::vector<FaceLights>& faces, const std::vector<Sighting>& seen,
                         const TriangulateOptions& options);

}  // namespace faceprobe::lighting
