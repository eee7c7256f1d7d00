#pragma once
// Internal: limited-memory BFGS (Nocedal & Wright 2006, algorithm 7.4) with halved steps. For smooth functions; deterministic.

#include <Eigen/Core>
#include <functional>

namespace faceprobe::lighting {

// Lowers f from x, in place, by at most `steps` steps, none of which changes a number by more than `longest`. f(x, gradient) returns the value and
// fills the gradient. Returns the last value.
double minimise_lbfgs(const std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>& f, int steps,
                      double longest, Eigen::VectorXd& x);

}  // namespace faceprobe::lighting
