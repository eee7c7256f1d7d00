#pragma once

#include <Eigen/Geometry>

namespace faceprobe::synth {

// Roll about +z first, then pitch about +x, then yaw about +y; radians.
inline Eigen::Matrix3f turn(double yaw, double pitch, double roll) {
  using Axis = Eigen::AngleAxisf;
  return (Axis(static_cast<float>(yaw), Eigen::Vector3f::UnitY()) *
          Axis(static_cast<float>(pitch), Eigen::Vector3f::UnitX()) *
          Axis(static_cast<float>(roll), Eigen::Vector3f::UnitZ()))
      .toRotationMatrix();
}

}  // namespace faceprobe::synth
