#pragma once
// A smooth bend of the plane that takes some points to others: thin-plate spline (Bookstein 1989, "Principal warps").

#include <Eigen/Core>

namespace faceprobe::pipeline {

class ThinPlateWarp {
 public:
  // `softness`: 0 goes through the points; larger values, of the order of 1, pass by. At least four points, not on one line.
  ThinPlateWarp(const Eigen::MatrixX2f& from, const Eigen::MatrixX2f& to, double softness);
  Eigen::Vector2f operator()(const Eigen::Vector2f& point) const;

 private:
  Eigen::MatrixX2d centre_;  // scaled to a unit square
  Eigen::MatrixX2d weight_;  // #points + 3
  Eigen::Vector2d origin_;
  double scale_ = 1;
};

}  // namespace faceprobe::pipeline
