#pragma once
// A cubic Bezier curve.
//
//   const Bezier<3> arm{shoulder, down, in, hand};
//   const Eigen::Vector3f elbow = arm.at(0.5F);

#include <Eigen/Core>

namespace faceprobe::render {

template <int N>
struct Bezier {
  using Point = Eigen::Matrix<float, N, 1>;
  Point a, b, c, d;  // from a towards b, from the side of c to d

  Point at(float t) const {
    const float s = 1 - t;
    return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
  }
  // Unit length. Neighbouring points must differ.
  Point tangent(float t) const {
    const float s = 1 - t;
    return Point(s * s * (b - a) + 2 * s * t * (c - b) + t * t * (d - c)).normalized();
  }
};

}  // namespace faceprobe::render
