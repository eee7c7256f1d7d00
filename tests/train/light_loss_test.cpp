#include "train/light_loss.h"

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/face_features.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

torch::Tensor lamp(const Eigen::Vector3f& towards, float strength) {
  torch::Tensor light = torch::full({1, lighting::kFeatureCells, 3}, 0.1F);
  light[0][SphereGrid(lighting::kFeatureNside).cell_of(towards)] += strength;
  return light;
}

TEST(LightLoss, IsNoughtForTheTruth) {
  const LightLoss loss;
  const torch::Tensor light = lamp({0.5F, 0.5F, 0.7F}, 20);
  const LightLoss::Terms terms = loss.terms(light, light);
  EXPECT_NEAR(terms.diffuse.item<double>(), 1e-3, 1e-6);  // the floor under the root
  EXPECT_NEAR(terms.glossy.item<double>(), 0, 1e-6);
  EXPECT_NEAR(terms.shape.item<double>(), 1e-3, 1e-6);
}

TEST(LightLoss, TheShapeDoesNotKnowTheLevel) {
  const LightLoss loss;
  const torch::Tensor truth = lamp({0.5F, 0.5F, 0.7F}, 20);
  const torch::Tensor other = lamp({0.2F, 0.6F, 0.7F}, 12);
  const LightLoss::Terms once = loss.terms(other, truth);
  const LightLoss::Terms thrice = loss.terms(3 * other, truth);
  EXPECT_GT(once.shape.item<double>(), 0.02);
  EXPECT_NEAR(thrice.shape.item<double>(), once.shape.item<double>(), 1e-5);  // single precision
  EXPECT_GT(std::abs(thrice.diffuse.item<double>() - once.diffuse.item<double>()), 0.02);
}

TEST(LightLoss, GrowsWithTheAngle) {
  const LightLoss loss;
  const torch::Tensor truth = lamp({0, 0, 1}, 20);
  double last = 0;
  for (const double angle_deg : {40, 65, 90}) {
    const auto angle = static_cast<float>(angle_deg * 3.14159265 / 180);
    const LightLoss::Terms terms = loss.terms(lamp({std::sin(angle), 0, std::cos(angle)}, 20), truth);
    EXPECT_GT(terms.diffuse.item<double>(), last);
    EXPECT_GT(terms.glossy.item<double>(), 0.1);
    last = terms.diffuse.item<double>();
  }
}

// Light from straight behind falls on nothing that the camera sees; the glossy ball mirrors it at its rim.
TEST(LightLoss, TheDiffuseBallDoesNotKnowWhatIsStraightBehind) {
  const LightLoss loss;
  const LightLoss::Terms terms = loss.terms(lamp({0, 0, -1}, 20), lamp({0, 0, -1}, 0));
  EXPECT_LT(terms.diffuse.item<double>(), 0.1);  // the cell is 15 degrees wide, and the rim sees its edge
  EXPECT_GT(terms.glossy.item<double>(), 0.05);
}

// No bright spot anywhere may pay: it would make the rest of the ball small beside it.
TEST(LightLoss, ABrighterSpotNeverLooksLikeAGain) {
  const LightLoss loss;
  const torch::Tensor truth = lamp({0.3F, 0.5F, 0.8F}, 20);
  torch::Tensor light = lamp({0.3F, 0.5F, 0.8F}, 20);
  const std::int64_t rim = SphereGrid(lighting::kFeatureNside).cell_of({0.9F, 0.3F, -0.3F});
  light[0][rim][2] += 30;
  light.set_requires_grad(true);
  loss.terms(light, truth).diffuse.backward();
  EXPECT_GT(light.grad()[0][rim][2].item<double>(), 0);
}

TEST(LightLoss, ItsGradientIsThatOfFiniteDifferences) {
  const LightLoss loss;
  torch::manual_seed(2);
  const torch::Tensor truth = torch::rand({2, lighting::kFeatureCells, 3}) + 0.1;
  // Darker than the truth, which then says what white is.
  const torch::Tensor light = (0.3 * torch::rand({2, lighting::kFeatureCells, 3}) + 0.1).set_requires_grad(true);
  const auto value = [&](const torch::Tensor& x) {
    const LightLoss::Terms terms = loss.terms(x, truth);
    return terms.diffuse + terms.glossy + terms.shape;
  };
  value(light).backward();
  const torch::NoGradGuard no_grad;
  const torch::Tensor step = torch::randn_like(light) * 3e-3;
  const double slope = (light.grad() * step).sum().item<double>();
  const double change = (value(light + step) - value(light - step)).item<double>() / 2;
  EXPECT_NEAR(change, slope, 0.02 * std::abs(slope) + 1e-5);  // single precision, and the curve of the step
}

}  // namespace
}  // namespace faceprobe::train
