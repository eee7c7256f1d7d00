#include "faceprobe/eval/image_metrics.h"

#include "eval/check_pictures.h"
#include "eval/row_mean.h"
#include "faceprobe/core/angles.h"

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

// term(estimate's value, truth's value) over all values of all pixels in the mask.
template <class Term>
Partial sum_values(const Image& estimate, const Image& truth, const ByteImage& mask, int threads, const Term& term) {
  return sum_rows(truth.height(), threads, [&](int y) {
    Partial row;
    for (int x = 0; x < truth.width(); ++x) {
      if (!mask.empty() && mask(x, y) == 0) continue;
      const float* e = estimate.pixel(x, y);
      const float* t = truth.pixel(x, y);
      for (int c = 0; c < truth.channels(); ++c) row.sum += term(static_cast<double>(e[c]), static_cast<double>(t[c]));
      row.count += truth.channels();
    }
    return row;
  });
}

double root_mean_square(const Image& estimate, const Image& truth, const ByteImage& mask, int threads, double scale) {
  return std::sqrt(mean(sum_values(estimate, truth, mask, threads, [scale](double e, double t) {
    const double difference = scale * e - t;
    return difference * difference;
  })));
}

}  // namespace

double rmse(const Image& estimate, const Image& truth, const ByteImage& mask, int threads) {
  check_pictures("rmse", estimate, truth, mask);
  return 255 * root_mean_square(estimate, truth, mask, threads, 1);
}

double psnr_of_rmse(double rmse_255) { return 20 * std::log10(255 / rmse_255); }

double si_rmse(const Image& estimate, const Image& truth, const ByteImage& mask, int threads) {
  check_pictures("si_rmse", estimate, truth, mask);
  const Partial cross = sum_values(estimate, truth, mask, threads, [](double e, double t) { return e * t; });
  const Partial own = sum_values(estimate, truth, mask, threads, [](double e, double) { return e * e; });
  // A black estimate stays black under any scale. The sum is taken anew with the scale, not from the closed form, which
  // cancels when the fit is good.
  return root_mean_square(estimate, truth, mask, threads, own.sum != 0 ? cross.sum / own.sum : 0);
}

double angular_error_deg(const Image& estimate, const Image& truth, const ByteImage& mask, double black, int threads) {
  check_pictures("angular_error_deg", estimate, truth, mask);
  if (truth.channels() != 3 && !truth.empty()) {
    throw std::invalid_argument("angular_error_deg: the pictures must have 3 channels, not " +
                                std::to_string(truth.channels()));
  }
  return mean(sum_rows(truth.height(), threads, [&](int y) {
    Partial row;
    for (int x = 0; x < truth.width(); ++x) {
      if (!mask.empty() && mask(x, y) == 0) continue;
      const Eigen::Vector3d e = Eigen::Map<const Eigen::Vector3f>(estimate.pixel(x, y)).cast<double>();
      const Eigen::Vector3d t = Eigen::Map<const Eigen::Vector3f>(truth.pixel(x, y)).cast<double>();
      // NaN is not left out, so that it shows in the mean.
      if (e.norm() <= black || t.norm() <= black) continue;
      row.sum += angle_between_deg(e, t);
      row.count += 1;
    }
    return row;
  }));
}

}  // namespace faceprobe::eval
