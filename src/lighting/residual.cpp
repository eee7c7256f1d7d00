#include "lighting/residual.h"

#include <cmath>

namespace faceprobe::lighting {

std::optional<double> relative_residual(const Eigen::MatrixXf& predicted, const Eigen::MatrixXf& data,
                                        const Eigen::VectorXf& weight,
                                        const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& bound) {
  double missed = 0;
  double all = 0;
  for (Eigen::Index c = 0; c < data.cols(); ++c) {
    for (Eigen::Index i = 0; i < data.rows(); ++i) {
      const auto w = static_cast<double>(weight[i]);
      const auto found = static_cast<double>(data(i, c));
      const double miss = static_cast<double>(predicted(i, c)) - found;
      all += w * found * found;
      if (miss < 0 || bound.size() == 0 || !bound(i, c)) missed += w * miss * miss;
    }
  }
  if (!(all > 0)) return std::nullopt;
  return std::sqrt(missed / all);
}

}  // namespace faceprobe::lighting
