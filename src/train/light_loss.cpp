#include "train/light_loss.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/face_features.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

constexpr float kFront = -0.05F;  // least z of a normal that a camera sees, with a little beyond the rim
constexpr float kLobe = 15;  // exponent of a lobe a little narrower than skin's: the map should be sharper than the skin
constexpr double kFloor = 0.03;        // of the level: darker light is all alike
constexpr double kGlossCorner = 0.03;  // where an absolute error is rounded off
constexpr double kLeastSquare = 1e-6;

torch::Tensor normalised(const torch::Tensor& rows) { return rows / rows.sum(1, true); }

}  // namespace

LightLoss::LightLoss() {
  const SphereGrid grid(lighting::kFeatureNside);
  const auto cells = static_cast<std::int64_t>(grid.cell_count());
  torch::Tensor cosines = torch::empty({cells, cells});
  std::vector<std::int64_t> front;
  for (int i = 0; i < grid.cell_count(); ++i) {
    if (grid.direction(i).z() > kFront) front.push_back(i);
    for (int j = 0; j < grid.cell_count(); ++j)
      cosines.data_ptr<float>()[i * cells + j] = std::max(0.0F, grid.direction(i).dot(grid.direction(j)));
  }
  const torch::Tensor seen = torch::tensor(front, torch::kLong);
  diffuse_rows_ = cosines.index_select(0, seen) * (grid.cell_solid_angle() / kPi);
  lobe_rows_ = normalised(cosines.pow(kLobe));
}

LightLoss::Terms LightLoss::terms(const torch::Tensor& found, const torch::Tensor& truth) const {
  const torch::Tensor ball = torch::matmul(diffuse_rows_, found);
  const torch::Tensor true_ball = torch::matmul(diffuse_rows_, truth);
  // Over the brighter of the two, so that neither a lamp too many nor one too few is without bounds; as a constant, or one bright spot would
  // make all other errors small.
  const torch::Tensor brightest = torch::maximum(ball.detach().amax({1, 2}, true), true_ball.amax({1, 2}, true));
  const torch::Tensor error = (ball - true_ball) / brightest;
  const torch::Tensor shape = ball / ball.amax({1, 2}, true) - true_ball / true_ball.amax({1, 2}, true);
  const torch::Tensor glossy =
      (torch::matmul(lobe_rows_, found) + kFloor).log() - (torch::matmul(lobe_rows_, truth) + kFloor).log();
  const auto root_mean_square = [](const torch::Tensor& difference) {
    return (difference.square().mean({1, 2}) + kLeastSquare).sqrt().mean();
  };
  return {root_mean_square(error), (glossy.square() + kGlossCorner * kGlossCorner).sqrt().mean() - kGlossCorner,
          root_mean_square(shape)};
}

}  // namespace faceprobe::train
