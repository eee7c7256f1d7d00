#pragma once
// A light with shares of its main lights taken off, each alone.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/main_lights.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::pipeline {

// `shares`: of the main lights in their order, 0 (stays) to 1 (goes); those of more lights than there are, are of no matter. What a share of 1
// takes off is what lighting::without_main_lights() does. Throws as that.
Eigen::MatrixX3f dimmed_lights(const Eigen::MatrixX3f& radiance, const SphereGrid& grid,
                               const std::vector<double>& shares, const lighting::MainLightOptions& options,
                               const Eigen::VectorXf& confidence);

}  // namespace faceprobe::pipeline
