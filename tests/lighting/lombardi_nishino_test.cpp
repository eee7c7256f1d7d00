#include "faceprobe/lighting/lombardi_nishino.h"

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/main_lights.h"
#include "lighting/joint_objective.h"
#include "lighting/lbfgs.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <functional>

namespace faceprobe::lighting {
namespace {

Observations face_under(const Eigen::Vector3d& towards, float ambient = 0.03F,
                        const Eigen::RowVector3f& colour = {1, 1, 1}, float noise = 0) {
  const SphereGrid grid(16);
  Observations face = testing::ellipsoid_face(30);
  testing::light_up(face, grid, testing::lamp(grid, towards, 6, ambient, colour), noise);
  return face;
}

Eigen::VectorXd uneven(Eigen::Index count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, 0.7);
  Eigen::VectorXd u(count);
  for (double& value : u) value = normal(random);
  return u;
}

// Greatest difference between a gradient and central differences, over the gradient's greatest number.
double gradient_fault(const std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>& f,
                      const Eigen::VectorXd& at) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(at.size());
  Eigen::VectorXd unused = gradient;
  f(at, gradient);
  double fault = 0;
  constexpr double kStep = 1e-4;
  for (Eigen::Index j = 0; j < at.size(); j += 7) {
    Eigen::VectorXd more = at;
    Eigen::VectorXd less = at;
    more[j] += kStep;
    less[j] -= kStep;
    fault = std::max(fault, std::abs((f(more, unused) - f(less, unused)) / (2 * kStep) - gradient[j]));
  }
  return fault / gradient.cwiseAbs().maxCoeff();
}

TEST(LombardiNishino, GradientsAreThoseOfFiniteDifferences) {
  const SphereGrid grid(4);
  const auto edges = neighbours(grid);
  const Eigen::VectorXd u = uneven(grid.cell_count());
  // Histograms are cut off at four widths, where a Gaussian is 3e-4 of its peak.
  EXPECT_LT(gradient_fault([&](const auto& at, auto& gradient) { return gradient_prior(edges, at, 1, gradient); }, u),
            1e-5);
  EXPECT_LT(gradient_fault([&](const auto& at, auto& gradient) { return entropy_prior(at, 1, gradient); }, u), 1e-2);
  Observations face = face_under({1, 1, 2});
  face.clipped.topRows(40).setConstant(true);
  const JointObjective objective(face, {.nside = 4, .threads = 1});
  EXPECT_LT(gradient_fault([&](const auto& at, auto& gradient) { return objective.value(at, 1, gradient); }, u), 1e-3);
}

TEST(LombardiNishino, EveryCellHasNeighboursAllAround) {
  const SphereGrid grid(8);
  std::vector<int> count(static_cast<std::size_t>(grid.cell_count()), 0);
  for (const auto& [a, b] : neighbours(grid)) {
    ++count[static_cast<std::size_t>(a)];
    ++count[static_cast<std::size_t>(b)];
    EXPECT_LT(a, b);
  }
  EXPECT_GE(*std::min_element(count.begin(), count.end()), 3);
  EXPECT_LE(*std::max_element(count.begin(), count.end()), 8);
}

TEST(LombardiNishino, EntropyIsLeastWhereValuesAreAlike) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(192);
  const double even = entropy_prior(Eigen::VectorXd::Zero(192), 1, gradient);
  Eigen::VectorXd two = Eigen::VectorXd::Zero(192);
  two.head(10).setConstant(4);
  Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(192, 0, 4);
  EXPECT_LT(even, entropy_prior(two, 1, gradient));
  EXPECT_LT(entropy_prior(two, 1, gradient), entropy_prior(ramp, 1, gradient));
  // Shifting all values by whole bins changes nothing.
  EXPECT_NEAR(entropy_prior(ramp.array() + 1.0, 1, gradient), entropy_prior(ramp, 1, gradient), 1e-6);
}

TEST(LombardiNishino, TheOptimiserFindsTheBottomOfAValley) {
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  const double value = minimise_lbfgs(
      [](const Eigen::VectorXd& at, Eigen::VectorXd& gradient) {  // Rosenbrock's
        const double across = at[1] - at[0] * at[0];
        gradient = Eigen::Vector2d(-400 * at[0] * across - 2 * (1 - at[0]), 200 * across);
        return 100 * across * across + (1 - at[0]) * (1 - at[0]);
      },
      200, 1, x);
  EXPECT_LT(value, 1e-8);
  EXPECT_NEAR(x[0], 1, 1e-3);
}

TEST(LombardiNishino, SkinsLobeIsAboutThatOfTheTable) {
  const LobePrior prior = skin_lobe_prior();
  // m = .3, rho_s = .18: .18 * .028 / (pi m^2) = .018; as narrow as cos^19.
  // The mean is over ten regions, of the logarithms: within a third.
  EXPECT_NEAR(std::exp(prior.mean[0]), 0.018, 0.006);
  EXPECT_NEAR(std::exp(prior.mean[1]), 19, 5);
  EXPECT_GT(prior.covariance.determinant(), 0);
  EXPECT_GT(prior.covariance(0, 1), 0);  // shiny skins are smooth ones
}

// Degrees between the strongest light found and the lamp.
double lamp_error_deg(const JointEstimate& found, const Eigen::Vector3d& towards) {
  const std::vector<MainLight> lights = main_lights(found.radiance, SphereGrid(found.nside));
  return lights.empty() ? 180 : angle_between_deg(lights.front().direction, towards);
}

// The lamp turns about the face, and the answer with it. Not for a lamp beside the camera: the face's lobe rises towards grazing light, this one
// less, and a ring makes up for that.
TEST(LombardiNishino, ALampIsWhereItIs) {
  for (const auto& [azimuth, elevation] : {std::pair(40.0, 20.0), {-40.0, 20.0}, {60.0, -10.0}, {-20.0, 50.0}}) {
    const Eigen::Vector3d towards = direction_from_angles(azimuth, elevation);
    // One cell and a bit: cells are 7 degrees apart, and the lobe is not the face's.
    EXPECT_LT(lamp_error_deg(solve_lombardi_nishino(face_under(towards)), towards), 9) << azimuth << ", " << elevation;
  }
}

TEST(LombardiNishino, EnergyIsRight) {
  const SphereGrid grid(8);
  const Observations face = face_under(direction_from_angles(30, 20), 0.1F, {1.3F, 1, 0.6F});
  const JointEstimate found = solve_lombardi_nishino(face);
  const Eigen::MatrixX3f shading = build_transport(face, grid).diffuse() * found.radiance;
  // The lobe's strength has a prior and is not the face's: what it gets wrong, the light makes good.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shading.col(c).sum() / face.shading.col(c).sum(), 1, 0.1);
}

TEST(LombardiNishino, TheLobeComesBackFromItsOwnAppearance) {
  const SphereGrid grid(8);
  Observations face = testing::ellipsoid_face(22);
  face.highlight.setConstant(1);
  const JointOptions options{.noise = 0.02, .gradient = 0.3, .threads = 1};
  JointObjective model(face, options);
  const Eigen::Vector2d truth = model.prior().mean + Eigen::Vector2d(1, 0);
  model.set_lobe(truth);
  const Eigen::MatrixX3f light = testing::lamp(grid, direction_from_angles(25, 15), 6, 0.02F);
  ASSERT_EQ(model.transport().rows(), face.count());  // all rows used, in order
  face.highlight = (model.transport() * light.cast<double>()).cast<float>();
  // How wide a lamp is and how wide the lobe are hardly told apart; how strong the lobe is, is seen.
  const double found = std::log(solve_lombardi_nishino(face, options).lobe.kappa);
  EXPECT_LT(std::abs(found - truth[0]), 0.5);
}

// Energy within 25 degrees of the lamp.
double near_lamp(const JointEstimate& found, const Eigen::Vector3d& towards) {
  const SphereGrid grid(found.nside);
  double near = 0;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (angle_between_deg(grid.direction(j).cast<double>(), towards) < 25)
      near += static_cast<double>(found.radiance(j, 1));
  }
  return near / static_cast<double>(found.radiance.col(1).sum());
}

TEST(LombardiNishino, LowEntropySharpens) {
  const Eigen::Vector3d towards = direction_from_angles(35, 20);
  const Observations face = face_under(towards, 0.03F, {1, 1, 1}, 0.1F);
  const auto share = [&](double gradient, double entropy) {
    return near_lamp(solve_lombardi_nishino(face, {.gradient = gradient, .entropy = entropy}), towards);
  };
  EXPECT_GT(share(1, 3), share(1, 0));
  EXPECT_GT(share(0.1, 1), share(0.1, 0));
}

TEST(LombardiNishino, GreyInGreyOutAndColourInColourOut) {
  const Eigen::Vector3d towards = direction_from_angles(30, 10);
  const JointEstimate grey = solve_lombardi_nishino(face_under(towards));
  // Channels are solved apart, in single precision.
  EXPECT_LT((grey.radiance.col(0) - grey.radiance.col(1)).cwiseAbs().maxCoeff(), 1e-4F * grey.radiance.maxCoeff());
  const SphereGrid grid(8);
  const JointEstimate warm = solve_lombardi_nishino(face_under(towards, 0.1F, {1.4F, 1, 0.4F}));
  const int lamp = grid.cell_of(towards.cast<float>());
  // Loose: coarse cells about the lamp hold some of the white surround too.
  EXPECT_NEAR(warm.radiance(lamp, 0) / warm.radiance(lamp, 1), 1.4F, 0.15F);
  EXPECT_NEAR(warm.radiance(lamp, 2) / warm.radiance(lamp, 1), 0.4F, 0.15F);
  // The surround is white; colour comes to it from all that the patches see.
  const int away = grid.cell_of({-1, 0, 0.2F});
  EXPECT_LT(warm.radiance(away, 0) / warm.radiance(away, 1), 1.3F);
}

TEST(LombardiNishino, ClippedPatchesAreAtLeastAsBright) {
  const Eigen::Vector3d towards = direction_from_angles(40, 20);
  Observations face = face_under(towards);
  const float white = 0.7F * face.highlight.maxCoeff();
  for (Eigen::Index i = 0; i < face.count(); ++i) {
    if (face.highlight(i, 0) <= white) continue;
    face.highlight.row(i).setConstant(white);
    face.clipped.row(i).setConstant(true);
  }
  ASSERT_TRUE(face.clipped.any());
  const JointEstimate bounds = solve_lombardi_nishino(face);
  EXPECT_LT(lamp_error_deg(bounds, towards), 12);  // 9 as unclipped, and half a cell for the peak that is cut off
  face.clipped.setConstant(false);
  EXPECT_LT(solve_lombardi_nishino(face).radiance.maxCoeff(), bounds.radiance.maxCoeff());
}

TEST(LombardiNishino, TheSameForAnyNumberOfThreadsAndAnyScale) {
  Observations face = face_under({1, 0.5, 2});
  const JointEstimate once = solve_lombardi_nishino(face, {.threads = 1});
  EXPECT_EQ(once.radiance, solve_lombardi_nishino(face, {.threads = 3}).radiance);
  face.highlight *= 4;
  face.shading *= 4;
  EXPECT_LT((solve_lombardi_nishino(face).radiance - 4 * once.radiance).cwiseAbs().maxCoeff(),
            1e-3F * once.radiance.maxCoeff());
}

TEST(LombardiNishino, IsBlackWithoutLightAndRefusesWhatMakesNoSense) {
  const Observations face = testing::ellipsoid_face(20);
  EXPECT_TRUE(solve_lombardi_nishino(face).radiance.isZero());
  Observations none;
  none.resize(0);
  EXPECT_EQ(solve_lombardi_nishino(none).radiance.rows(), 768);
  EXPECT_THROW(solve_lombardi_nishino(face, {.nside = 1}), std::invalid_argument);
  EXPECT_THROW(solve_lombardi_nishino(face, {.noise = 0}), std::invalid_argument);
  EXPECT_THROW(solve_lombardi_nishino(face, {.entropy = -1}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting
