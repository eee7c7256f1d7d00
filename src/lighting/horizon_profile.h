#pragma once
// Horizon look-ups without trigonometry in the inner loop: azimuth and elevation of the light's directions are worked out once, those
// of a patch's horizon once per patch.

#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace faceprobe::lighting {

struct HorizonPlace {
  int before = 0;  // the two stored azimuths around the direction
  int after = 0;
  float fraction = 0;   // of the way from one to the other
  float elevation = 0;  // over the image plane, radians
};

using HorizonProfile = std::array<float, kHorizonAzimuths>;  // elevations, radians

HorizonPlace horizon_place(const Eigen::Vector3f& direction);
std::vector<HorizonPlace> horizon_places(const Eigen::MatrixX3f& directions);
HorizonProfile horizon_profile(const Eigen::Ref<const Eigen::RowVectorXf>& tangents);
// 0..1 over a soft edge of 4 degrees.
float profile_visibility(const HorizonProfile& profile, const HorizonPlace& place);

}  // namespace faceprobe::lighting
