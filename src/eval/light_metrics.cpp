#include "faceprobe/eval/light_metrics.h"

#include "eval/nan.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/eval/image_metrics.h"
#include "faceprobe/eval/statistics.h"
#include "faceprobe/lighting/main_lights.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace faceprobe::eval {
namespace {

Image scaled_and_clipped(Image image, float gain) {
  for (float& value : image.values()) value = std::min(1.0F, gain * value);
  return image;
}

float brightest(const Image& image) { return *std::max_element(image.values().begin(), image.values().end()); }

struct Sphere {
  Image colour;
  ByteImage mask;
};

Sphere sphere(const Eigen::MatrixX3f& light, const SphereGrid& grid, render::SphereMaterial material) {
  constexpr int kSizePx = 64;
  const Image drawn = render::render_sphere(light, grid, {.material = material, .size_px = kSizePx});
  Sphere out{Image(kSizePx, kSizePx, 3), ByteImage(kSizePx, kSizePx, 1)};
  for (int y = 0; y < kSizePx; ++y) {
    for (int x = 0; x < kSizePx; ++x) {
      out.mask(x, y) = drawn(x, y, 3) >= 1 ? 1 : 0;
      std::copy_n(drawn.pixel(x, y), 3, out.colour.pixel(x, y));
    }
  }
  return out;
}

double mean_of(const Sphere& s) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < s.colour.values().size(); ++i) {
    if (s.mask.data()[i / 3] == 0) continue;
    sum += static_cast<double>(s.colour.data()[i]);
    ++count;
  }
  return sum / count;
}

// To [0, 1] between two percentiles of the masked values.
Image spread(const Sphere& s) {
  std::vector<double> values;
  for (std::size_t i = 0; i < s.colour.values().size(); ++i) {
    if (s.mask.data()[i / 3] != 0) values.push_back(static_cast<double>(s.colour.data()[i]));
  }
  std::sort(values.begin(), values.end());
  const double low = quantile_of_sorted(values, 0.001);
  const double range = std::max(1e-12, quantile_of_sorted(values, 0.999) - low);
  Image out = s.colour;
  for (float& value : out.values())
    value = static_cast<float>(std::clamp((static_cast<double>(value) - low) / range, 0.0, 1.0));
  return out;
}

Eigen::VectorXd with_mean_one(const Eigen::MatrixX3f& light) {
  const Eigen::VectorXd luminance = (light * kLuminanceWeights).cast<double>();
  return luminance / luminance.mean();
}

}  // namespace

RelightError relight_error(const LitObject& object, const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate) {
  const LitPictures right = object.light(truth);
  const LitPictures found = object.light(estimate);
  const float white_right = brightest(right.diffuse);
  const float white_found = brightest(found.diffuse);
  if (!(white_right > 0 && white_found > 0)) return {kNaN, kNaN};
  const auto error = [&](const Image& f, const Image& r) {
    return rmse(scaled_and_clipped(f, 1 / white_found), scaled_and_clipped(r, 1 / white_right), object.mask());
  };
  return {error(found.diffuse, right.diffuse), error(found.glossy, right.glossy)};
}

SphereError sphere_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate, const SphereGrid& grid,
                         render::SphereMaterial material) {
  const double white = mean_of(sphere(truth, grid, render::SphereMaterial::kDiffuse));
  if (!(white > 0) || !(estimate.maxCoeff() > 0)) return {kNaN, kNaN, kNaN};
  Sphere right = sphere(truth, grid, material);
  const Sphere found = sphere(estimate, grid, material);
  for (float& value : right.colour.values()) value /= static_cast<float>(white);
  SphereError error;
  error.si_rmse = si_rmse(found.colour, right.colour, right.mask);
  error.angular_deg = angular_error_deg(found.colour, right.colour, right.mask, 1e-6);
  error.nrmse = rmse(spread(found), spread(right), right.mask) / 255;
  return error;
}

MapError map_error(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate) {
  if (!(truth.maxCoeff() > 0 && estimate.maxCoeff() > 0)) return {kNaN, kNaN};
  const Eigen::VectorXd right = with_mean_one(truth);
  const Eigen::VectorXd found = with_mean_one(estimate);
  const double error = std::sqrt((found - right).squaredNorm() / static_cast<double>(right.size()));
  const auto range = [](const Eigen::VectorXd& v) { return v.maxCoeff() - v.minCoeff(); };
  const auto over = [error](double span) { return span > 0 ? error / span : kNaN; };
  return {over(range(found)), over(range(right))};
}

bool has_dominant_light(const Eigen::MatrixX3f& truth, const SphereGrid& grid) {
  const std::vector<lighting::MainLight> lights = lighting::main_lights(truth, grid);
  if (lights.empty() || lights[0].share < 0.25) return false;
  return lights.size() == 1 || lights[0].irradiance >= 2 * lights[1].irradiance;
}

double main_light_error_deg(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate, const SphereGrid& grid) {
  const std::vector<lighting::MainLight> right = lighting::main_lights(truth, grid);
  if (right.empty() || !(estimate.maxCoeff() > 0)) return kNaN;
  const std::vector<lighting::MainLight> found = lighting::main_lights(estimate, grid);
  const Eigen::VectorXf level = estimate * kLuminanceWeights;
  if (found.empty() && lighting::is_even(level.cast<double>())) return kNaN;
  Eigen::Index cell = 0;
  level.maxCoeff(&cell);
  const Eigen::Vector3d direction =
      found.empty() ? Eigen::Vector3d(grid.directions().row(cell).transpose().cast<double>()) : found[0].direction;
  return angle_between_deg(right[0].direction, direction);
}

double light_colour_error_deg(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& estimate) {
  const Eigen::Vector3d right = truth.cast<double>().colwise().sum().transpose();
  const Eigen::Vector3d found = estimate.cast<double>().colwise().sum().transpose();
  if (!(right.norm() > 0 && found.norm() > 0)) return kNaN;
  return angle_between_deg(right, found);
}

}  // namespace faceprobe::eval
