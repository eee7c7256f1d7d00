#pragma once
// Internal: how much of what was observed a light leaves unexplained (Light::highlight_residual, Light::shading_residual).

#include <Eigen/Core>
#include <optional>

namespace faceprobe::lighting {

// sqrt(sum w (p - d)^2 / sum w d^2) over rows and channels; `predicted` and `data`: #rows x #channels; `weight`: #rows. Where `bound` (#rows x
// #channels, or empty) is true d is a lower bound: a larger p misses by nothing. Unset where the data hold no light.
std::optional<double> relative_residual(const Eigen::MatrixXf& predicted, const Eigen::MatrixXf& data,
                                        const Eigen::VectorXf& weight,
                                        const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& bound = {});

}  // namespace faceprobe::lighting
