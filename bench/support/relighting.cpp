#include "support/relighting.h"

#include "faceprobe/render/sphere.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {

namespace {

float brightest(const Image& ball) {
  float most = 0;
  for (int y = 0; y < ball.height(); ++y) {
    for (int x = 0; x < ball.width(); ++x) {
      if (ball(x, y, 3) < 1.0F) continue;
      for (int c = 0; c < 3; ++c) most = std::max(most, ball(x, y, c));
    }
  }
  return most > 0 ? most : 1.0F;
}

double rmse(const Image& a, float gain_a, const Image& b, float gain_b) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (a(x, y, 3) < 1.0F) continue;
      for (int c = 0; c < 3; ++c) {
        const double d = std::min(1.0F, a(x, y, c) * gain_a) - std::min(1.0F, b(x, y, c) * gain_b);
        sum += d * d;
        ++count;
      }
    }
  }
  return 255.0 * std::sqrt(sum / count);
}

}  // namespace

RelightingError relighting_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate,
                                 const SphereGrid& grid, int size_px) {
  using render::SphereMaterial;
  const auto ball = [&](const Eigen::MatrixX3f& light, SphereMaterial material) {
    return render::render_sphere(light, grid, {.material = material, .size_px = size_px});
  };
  const Image diffuse_truth = ball(truth, SphereMaterial::kDiffuse);
  const Image diffuse_estimate = ball(estimate, SphereMaterial::kDiffuse);
  const float gain_truth = 1.0F / brightest(diffuse_truth);
  const float gain_estimate = 1.0F / brightest(diffuse_estimate);
  RelightingError error;
  error.diffuse = rmse(diffuse_truth, gain_truth, diffuse_estimate, gain_estimate);
  error.mirror =
      rmse(ball(truth, SphereMaterial::kMirror), gain_truth, ball(estimate, SphereMaterial::kMirror), gain_estimate);
  return error;
}

}  // namespace faceprobe::bench
