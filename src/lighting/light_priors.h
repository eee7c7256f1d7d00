#pragma once
// Internal: what natural light is like, as penalties of the logarithm u of each cell's luminance, with their gradients (lombardi_nishino.h).

#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

// Pairs of cells beside one another, the lower number first.
std::vector<std::pair<int, int>> neighbours(const SphereGrid& grid);

// sum_edges log(1 + (u_a - u_b)^2 / s^2); adds `weight` times its gradient.
double gradient_prior(const std::vector<std::pair<int, int>>& edges, const Eigen::VectorXd& u, double weight,
                      Eigen::VectorXd& gradient);
// #cells times the entropy of the values' histogram, nats, each cell spread over the bins around it by a Gaussian; adds `weight` times its gradient.
double entropy_prior(const Eigen::VectorXd& u, double weight, Eigen::VectorXd& gradient);

}  // namespace faceprobe::lighting
