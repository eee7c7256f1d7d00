#include "lighting/lbfgs.h"

#include <algorithm>
#include <deque>
#include <vector>

namespace faceprobe::lighting {
namespace {

constexpr std::size_t kMemory = 8;
constexpr int kHalvings = 12;
constexpr double kArmijo = 1e-4;

struct Pair {
  Eigen::VectorXd step, change;  // of x, of the gradient
  double curvature;              // their product, above 0
};

Eigen::VectorXd downhill(const std::deque<Pair>& memory, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd q = gradient;
  std::vector<double> alpha(memory.size());
  for (std::size_t k = memory.size(); k-- > 0;) {
    alpha[k] = memory[k].step.dot(q) / memory[k].curvature;
    q -= alpha[k] * memory[k].change;
  }
  if (!memory.empty()) q *= memory.back().curvature / memory.back().change.squaredNorm();
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const double beta = memory[k].change.dot(q) / memory[k].curvature;
    q += (alpha[k] - beta) * memory[k].step;
  }
  return -q;
}

}  // namespace

double minimise_lbfgs(const std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>& f, int steps,
                      double longest, Eigen::VectorXd& x) {
  Eigen::VectorXd gradient(x.size());
  Eigen::VectorXd next_gradient(x.size());
  double value = f(x, gradient);
  std::deque<Pair> memory;
  for (int step = 0; step < steps; ++step) {
    Eigen::VectorXd direction = downhill(memory, gradient);
    double slope = direction.dot(gradient);
    if (!(slope < 0)) {
      memory.clear();
      direction = -gradient;
      slope = -gradient.squaredNorm();
      if (!(slope < 0)) break;
    }
    const double most = direction.cwiseAbs().maxCoeff();
    // Nothing is known of the scale yet at the first step.
    double length = memory.empty() ? longest / most : std::min(1.0, longest / most);
    bool lower = false;
    for (int halving = 0; halving < kHalvings && !lower; ++halving, length *= 0.5) {
      Eigen::VectorXd next = x + length * direction;
      const double next_value = f(next, next_gradient);
      if (!(next_value <= value + kArmijo * length * slope)) continue;
      lower = true;
      Pair pair{next - x, next_gradient - gradient, 0};
      pair.curvature = pair.step.dot(pair.change);
      if (pair.curvature > 1e-10 * pair.step.norm() * pair.change.norm()) {
        if (memory.size() == kMemory) memory.pop_front();
        memory.push_back(std::move(pair));
      }
      x = std::move(next);
      gradient.swap(next_gradient);
      value = next_value;
    }
    if (!lower) break;
  }
  return value;
}

}  // namespace faceprobe::lighting
