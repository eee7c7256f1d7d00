#include "highlight/local_models.h"

#include "faceprobe/core/parallel.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstddef>

namespace faceprobe::highlight {
namespace {

// Sums of (1, picture) (1, picture, highlight)^T. In double: a covariance is a small difference of large numbers.
using Moments = Eigen::Matrix<double, 4, 7>;

void add_pixel(const Small& small, int x, int y, Moments* sum) {
  if (small.usable(x, y) == 0) return;
  const float* p = small.picture.pixel(x, y);
  const float* h = small.highlight.pixel(x, y);
  const Eigen::Vector4d colour(1, p[0], p[1], p[2]);
  const Eigen::Matrix<double, 7, 1> all{1.0, p[0], p[1], p[2], h[0], h[1], h[2]};
  sum->noalias() += colour * all.transpose();
}

// One row of sums over windows, cut at the borders. add(x, y, &sum) adds what is at (x, y).
template <class Sum, class Add>
void window_sums(int width, int height, int radius, int y, const Add& add, std::vector<Sum>* columns,
                 std::vector<Sum>* out) {
  columns->assign(static_cast<std::size_t>(width), Sum::Zero());
  for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v) {
    for (int x = 0; x < width; ++x) add(x, v, &(*columns)[static_cast<std::size_t>(x)]);
  }
  out->assign(static_cast<std::size_t>(width), Sum::Zero());
  for (int x = 0; x < width; ++x) {
    Sum sum = Sum::Zero();
    for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u) {
      sum += (*columns)[static_cast<std::size_t>(u)];
    }
    (*out)[static_cast<std::size_t>(x)] = sum;
  }
}

// Ridge regression (He, Sun & Tang 2013, equations 19 and 20), times the number of pixels, which (3, 3) then holds: while
// windows are averaged, those that a border or the mask cut count less.
Model weighted_fit(const Moments& moments, double epsilon) {
  const double count = moments(0, 0);
  if (count == 0) return Model::Zero();
  const Eigen::Vector3d mean = moments.block<3, 1>(1, 0) / count;
  const Eigen::RowVector3d highlight = moments.block<1, 3>(0, 4) / count;
  Eigen::Matrix3d covariance = moments.block<3, 3>(1, 1) / count - mean * mean.transpose();
  covariance.diagonal().array() += epsilon;
  const Eigen::Matrix3d cross = moments.block<3, 3>(1, 4) / count - mean * highlight;
  const Eigen::Matrix3d slope = covariance.llt().solve(cross);  // one column for each channel of the highlight
  Eigen::Matrix4d model = Eigen::Matrix4d::Identity();
  model.topLeftCorner<3, 3>() = slope.transpose();
  model.topRightCorner<3, 1>() = (highlight - mean.transpose() * slope).transpose();
  return (count * model).cast<float>();
}

}  // namespace

std::vector<Model> fit_local_models(const Small& small, int radius, double epsilon, int threads) {
  const int count = small.picture.width();
  const int height = small.picture.height();
  const auto width = static_cast<std::size_t>(count);
  std::vector<Model> fits(small.picture.pixel_count());
  parallel_for(height, threads, [&](int first, int last) {
    std::vector<Moments> columns;
    std::vector<Moments> sums;
    const auto add = [&](int x, int y, Moments* sum) { add_pixel(small, x, y, sum); };
    for (int y = first; y < last; ++y) {
      window_sums(count, height, radius, y, add, &columns, &sums);
      Model* row = fits.data() + static_cast<std::size_t>(y) * width;
      for (std::size_t x = 0; x < width; ++x) row[x] = weighted_fit(sums[x], epsilon);
    }
  });
  std::vector<Model> models(fits.size());
  parallel_for(height, threads, [&](int first, int last) {
    std::vector<Model> columns;
    std::vector<Model> sums;
    const auto add = [&](int x, int y, Model* sum) {
      *sum += fits[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
    };
    for (int y = first; y < last; ++y) {
      window_sums(count, height, radius, y, add, &columns, &sums);
      Model* row = models.data() + static_cast<std::size_t>(y) * width;
      for (std::size_t x = 0; x < width; ++x) {
        const float weight = sums[x](3, 3);
        row[x] = weight > 0 ? Model(sums[x] / weight) : Model::Zero();
      }
    }
  });
  return models;
}

}  // namespace faceprobe::highlight
