#include "train/regressor_loss.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

constexpr int kSide = 16;  // height of a panorama

torch::Tensor direction_tensor(double azimuth, double elevation) {
  const Eigen::Vector3d d = direction_from_angles(azimuth, elevation);
  return torch::tensor({static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())});
}

// A round lamp in a dim room, 1 x points x 3.
torch::Tensor lamp_light(const LightPoints& points, double azimuth, double elevation, float strength = 40) {
  const torch::Tensor near = torch::matmul(points.direction, direction_tensor(azimuth, elevation)) > std::cos(0.3F);
  return (0.1F + strength * near.to(torch::kFloat)).view({1, -1, 1}).expand({1, -1, 3}).contiguous();
}

TEST(LightPoints, CoverTheSphereAndKnowTheirMirrorImage) {
  for (const LightPoints& points : {points_of_grid(4), points_of_panorama(kSide)}) {
    EXPECT_NEAR(points.solid_angle.sum().item<double>(), 4 * kPi, 1e-4);
    EXPECT_LT((points.direction.norm(2, 1) - 1).abs().max().item<float>(), 1e-5F);
    const torch::Tensor mirrored = points.direction.index_select(0, points.mirror);
    EXPECT_LT((mirrored - points.direction * torch::tensor({-1.0F, 1.0F, 1.0F})).abs().max().item<float>(), 1e-5F);
  }
}

TEST(LobeRows, AreMeansThatNarrow) {
  const LightPoints points = points_of_panorama(kSide);
  const torch::Tensor about = points_of_grid(4).direction;
  for (const double exponent : {1.0, 30.0}) {
    EXPECT_LT((lobe_rows(about, points, exponent).sum(1) - 1).abs().max().item<float>(), 1e-5F);
  }
  // Of a lamp 40 degrees away a wide lobe sees something, a narrow one nothing.
  const torch::Tensor light = lamp_light(points, 40, 0).select(2, 0).view({-1, 1}) - 0.1F;
  const torch::Tensor ahead = direction_tensor(0, 0).view({1, 3});
  const double wide = torch::matmul(lobe_rows(ahead, points, 1), light).item<double>();
  EXPECT_GT(wide, 0.5);
  EXPECT_LT(torch::matmul(lobe_rows(ahead, points, 60), light).item<double>(), 0.1 * wide);
}

// Why Gardner's exponent grows: through a wide lobe a mask far from its place costs more than a near one, through a narrow one hardly.
TEST(LobeRows, WideOnesTellFarFromNear) {
  const LightPoints points = points_of_panorama(kSide);
  const torch::Tensor about = points_of_grid(8).direction;
  const auto cost = [&](double angle, double exponent) {
    const torch::Tensor off = (lamp_light(points, angle, 0) - lamp_light(points, 0, 0)).select(2, 0).view({-1, 1});
    return torch::matmul(lobe_rows(about, points, exponent), off).square().mean().item<double>();
  };
  EXPECT_GT(cost(120, 1), 1.5 * cost(60, 1));
  EXPECT_LT(cost(120, 60), 1.1 * cost(60, 60));
}

TEST(BallPictures, AWhiteRoomIsAWhiteBall) {
  for (const LightPoints& points : {points_of_grid(8), points_of_panorama(kSide)}) {
    const BallPictures balls(points);
    EXPECT_NEAR(balls.level(torch::ones({1, points.count(), 3})).item<double>(), 1, 0.02);  // sums over points
  }
}

TEST(BallPictures, TheTruthIsNoError) {
  const LightPoints points = points_of_grid(8);
  const BallPictures balls(points);
  const torch::Tensor light = lamp_light(points, 40, 20);
  EXPECT_NEAR(balls.loss(light, light, {}).item<double>(), 0, 1e-6);
  // Nor is the truth at another exposure, but for the level.
  const RegressorErrors errors = balls.errors(3 * light, light);
  EXPECT_NEAR(errors.diffuse, 0, 1e-5);
  EXPECT_NEAR(errors.rough, 0, 1e-5);
  EXPECT_NEAR(errors.direction_deg, 0, 0.1);
  EXPECT_NEAR(errors.level, std::log(3.0), 1e-4);
  EXPECT_GT(balls.loss(3 * light, light, {}).item<double>(), 0.1);
}

TEST(BallPictures, ErrorsGrowWithTheAngle) {
  const LightPoints points = points_of_grid(8);
  const BallPictures balls(points);
  const torch::Tensor truth = lamp_light(points, 0, 0);
  double loss = 0;
  double diffuse = 0;
  for (const double angle : {20.0, 45.0, 80.0}) {
    const torch::Tensor light = lamp_light(points, angle, 0);
    const RegressorErrors errors = balls.errors(light, truth);
    EXPECT_NEAR(errors.direction_deg, angle, 2);  // a lamp is of whole cells
    EXPECT_GT(errors.diffuse, diffuse);
    EXPECT_GT(balls.loss(light, truth, {}).item<double>(), loss);
    diffuse = errors.diffuse;
    loss = balls.loss(light, truth, {}).item<double>();
  }
}

TEST(BallPictures, TheLossHasTheGradientOfFiniteDifferences) {
  const LightPoints points = points_of_grid(4);
  const BallPictures balls(points);
  torch::manual_seed(2);
  const torch::Tensor truth = torch::rand({2, points.count(), 3}) + 0.1;
  const torch::Tensor light = (torch::rand({2, points.count(), 3}) + 0.1).set_requires_grad(true);
  balls.loss(light, truth, {}).backward();
  const torch::NoGradGuard no_grad;
  const torch::Tensor step = light.grad() / light.grad().norm() * 1e-2;
  const double slope = (light.grad() * step).sum().item<double>();
  const double change = (balls.loss(light + step, truth, {}) - balls.loss(light - step, truth, {})).item<double>() / 2;
  EXPECT_NEAR(change, slope, 0.05 * std::abs(slope));  // absolute errors have corners
}

}  // namespace
}  // namespace faceprobe::train
