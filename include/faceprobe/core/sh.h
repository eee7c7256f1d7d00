#pragma once
// Real spherical harmonics, orthonormal on the sphere, in the order (0,0), (1,-1), (1,0), (1,1), (2,-2) .. (2,2), ...
// Coefficient l, m is number l (l + 1) + m. The polar axis is +z of the camera frame and (1,-1), (1,0), (1,1) go with y, z, x,
// the order of the lighting-estimation APIs of ARKit and WebXR; there is no Condon-Shortley sign, so Y_1,1 = +sqrt(3/4pi) x.
//
//   Eigen::MatrixX3d radiance = sh::project(map, 2);            // 9 x 3, radiance coefficients
//   Eigen::Vector3d  e = sh::irradiance(radiance, normal_cam);  // of the surface facing normal_cam
//
// Source: Ramamoorthi & Hanrahan 2001, "An efficient representation for irradiance environment maps".

#include "faceprobe/core/env_map.h"

#include <Eigen/Core>

namespace faceprobe::sh {

inline constexpr int coefficient_count(int order) { return (order + 1) * (order + 1); }  // rows of a set of that order

// (order + 1)^2 values of the basis at a unit direction. order >= 0.
Eigen::VectorXd basis(int order, const Eigen::Vector3d& direction);

// (order + 1)^2 x 3 radiance coefficients of a map, order >= 0; red, green, blue.
Eigen::MatrixX3d project(const EnvMap& map, int order);

// Factor that turns radiance of band l into irradiance: pi, 2 pi / 3, pi / 4, 0, -pi / 24, ... (Eq. 8 of the source).
double cosine_lobe(int band);

// Irradiance (not divided by pi) at a unit normal from radiance coefficients of any order: (order + 1)^2 x 3.
// Red, green, blue; may be below 0 where the harmonics ring.
Eigen::Vector3d irradiance(const Eigen::MatrixX3d& radiance, const Eigen::Vector3d& normal);

}  // namespace faceprobe::sh
