#include "train/regressor_loss.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"

#include <vector>

namespace faceprobe::train {
namespace {

constexpr int kBallNside = 8;            // of the directions that balls are seen by
constexpr float kBallFront = -0.05F;     // least z of a normal that a camera sees, with a little beyond the rim
constexpr double kRoughExponent = 30;    // of a rough mirror's lobe
constexpr double kBallFloor = 0.03;      // of the level: darker light is all alike
constexpr double kEncoding = 1.0 / 2.2;  // of a camera

torch::Tensor directions_of(const SphereGrid& grid) {
  torch::Tensor out = torch::empty({grid.cell_count(), 3});
  Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(out.data_ptr<float>(), grid.cell_count(), 3) =
      grid.directions();
  return out;
}

torch::Tensor luminance_of(const torch::Tensor& light) {
  return (light * torch::tensor({kLuminanceWeights[0], kLuminanceWeights[1], kLuminanceWeights[2]})).sum(-1, true);
}

// Soft where it clips, so that a lamp that is too bright still has a gradient.
torch::Tensor as_taken(const torch::Tensor& light) {
  constexpr double kDark = 1e-3;
  return (light / (1 + light) + kDark).pow(kEncoding);
}

}  // namespace

LightPoints points_of_grid(int nside) {
  const SphereGrid grid(nside);
  LightPoints points{directions_of(grid), torch::full({grid.cell_count()}, static_cast<float>(grid.cell_solid_angle())),
                     torch::empty({grid.cell_count()}, torch::kLong)};
  for (int i = 0; i < grid.cell_count(); ++i) {
    const Eigen::Vector3f direction = grid.direction(i);
    points.mirror.data_ptr<std::int64_t>()[i] = grid.cell_of({-direction.x(), direction.y(), direction.z()});
  }
  return points;
}

LightPoints points_of_panorama(int height) {
  const EnvMap map(2 * height, height);
  const std::int64_t count = 2 * height * height;
  LightPoints points{torch::empty({count, 3}), torch::empty({count}), torch::empty({count}, torch::kLong)};
  std::int64_t i = 0;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x, ++i) {
      Eigen::Map<Eigen::Vector3f>(points.direction.data_ptr<float>() + 3 * i) = map.direction(x, y);
      points.solid_angle.data_ptr<float>()[i] = static_cast<float>(texel_solid_angle(y, map.width(), map.height()));
      points.mirror.data_ptr<std::int64_t>()[i] = y * map.width() + map.width() - 1 - x;
    }
  }
  return points;
}

torch::Tensor lobe_rows(const torch::Tensor& about, const LightPoints& points, double exponent) {
  const torch::Tensor lobe = torch::matmul(about, points.direction.t()).clamp_min(0).pow(exponent) * points.solid_angle;
  return lobe / lobe.sum(1, true);
}

BallPictures::BallPictures(const LightPoints& points)
    : share_((points.solid_angle / static_cast<float>(4 * kPi)).unsqueeze(1)), direction_(points.direction) {
  const torch::Tensor around = directions_of(SphereGrid(kBallNside));
  const torch::Tensor front = around.index_select(0, (around.select(1, 2) > kBallFront).nonzero().squeeze(1));
  diffuse_rows_ = torch::matmul(front, points.direction.t()).clamp_min(0) * points.solid_angle / static_cast<float>(kPi);
  rough_rows_ = lobe_rows(around, points, kRoughExponent);
}

torch::Tensor BallPictures::level(const torch::Tensor& light) const {
  return luminance_of(torch::matmul(diffuse_rows_, light)).mean(1, true);
}

torch::Tensor BallPictures::loss(const torch::Tensor& found, const torch::Tensor& truth,
                                 const RegressorConfig& config) const {
  const torch::Tensor white = level(truth);  // what a camera would make grey
  const auto difference = [&](const torch::Tensor& rows) {
    return (as_taken(torch::matmul(rows, found) / white) - as_taken(torch::matmul(rows, truth) / white)).abs().mean();
  };
  const torch::Tensor mirror =
      ((found / white + kBallFloor).log() - (truth / white + kBallFloor).log()).abs().mul(share_).sum(1).mean();
  return difference(diffuse_rows_) + config.rough_weight * difference(rough_rows_) + config.mirror_weight * mirror;
}

RegressorErrors BallPictures::errors(const torch::Tensor& found, const torch::Tensor& truth) const {
  const torch::NoGradGuard no_grad;
  const torch::Tensor found_level = level(found);
  const torch::Tensor true_level = level(truth);
  const torch::Tensor light = found / found_level;
  const torch::Tensor true_light = truth / true_level;

  const torch::Tensor ball = torch::matmul(diffuse_rows_, light);
  const torch::Tensor true_ball = torch::matmul(diffuse_rows_, true_light);
  const torch::Tensor brightest = torch::maximum(ball.amax({1, 2}, true), true_ball.amax({1, 2}, true));
  const torch::Tensor rough = (torch::matmul(rough_rows_, light) + kBallFloor).log() -
                              (torch::matmul(rough_rows_, true_light) + kBallFloor).log();
  const auto towards = [&](const torch::Tensor& x) { return (luminance_of(x) * share_ * direction_).sum(1); };
  const torch::Tensor a = towards(light);
  const torch::Tensor b = towards(true_light);
  // Accurate for small angles, where the cosine is not.
  const torch::Tensor angle = torch::atan2(torch::cross(a, b, 1).norm(2, 1), (a * b).sum(1));
  return {((ball - true_ball) / brightest).square().mean({1, 2}).sqrt().mean().item<double>(),
          rough.abs().mean().item<double>(), degrees(angle.mean().item<double>()),
          (found_level / true_level).log().abs().mean().item<double>()};
}

}  // namespace faceprobe::train
