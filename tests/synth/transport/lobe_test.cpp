#include "synth/transport/lobe.h"

#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/synth/lobe_sampler.h"
#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

const Eigen::Vector3f kUp(0, 0, 1);

Eigen::Vector3f tilted(double degrees_from_up) {
  return Eigen::Vector3d(std::sin(radians(degrees_from_up)), 0, std::cos(radians(degrees_from_up))).cast<float>();
}

double integral(const Eigen::Vector3f& view, const Microfacet& surface, const SphereGrid& grid) {
  double sum = 0;
  for (int c = 0; c < grid.cell_count(); ++c)
    sum += static_cast<double>(specular_lobe(kUp, view, grid.direction(c), surface));
  return sum * grid.cell_solid_angle();
}

TEST(Lobe, ArraysGiveWhatTheFormulaGives) {
  Random random({3});
  constexpr int kCount = 2000;
  Eigen::ArrayXf n_l(kCount), v_l(kCount), n_v(kCount), m(kCount), f0(kCount), n_h(kCount), v_h(kCount), out(kCount);
  Eigen::ArrayXf expected(kCount);
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector3f normal = random.direction();
    Eigen::Vector3f view = random.direction();
    if (view.dot(normal) < 0) view = -view;
    const Eigen::Vector3f light = random.direction();
    n_l(i) = normal.dot(light);
    v_l(i) = view.dot(light);
    n_v(i) = normal.dot(view);
    m(i) = static_cast<float>(random.between(0.1, 0.6));
    f0(i) = static_cast<float>(random.between(0.02, 1.0));
    expected(i) = specular_lobe(normal, view, light, {m(i), 1.0F, f0(i)});
  }
  lobe_values(n_l, v_l, n_v, m, f0, n_h, v_h, out);
  // 1 - (N.H)^2 is known to 1e-7, and is divided by m^2 >= .01 in the exponent, up to some tens.
  for (int i = 0; i < kCount; ++i) EXPECT_NEAR(out(i), expected(i), 1e-5F + 3e-4F * expected(i));
}

TEST(Lobe, IsReciprocal) {
  Random random({4});
  for (int i = 0; i < 500; ++i) {
    Eigen::Vector3f a = random.direction();
    Eigen::Vector3f b = random.direction();
    a.z() = std::abs(a.z());
    b.z() = std::abs(b.z());
    const Microfacet surface{0.3F, 0.25F, 0.04F};
    // f(L, V) N.L over N.L against the same with the two exchanged.
    const float there = specular_lobe(kUp, a, b, surface) / b.z();
    const float back = specular_lobe(kUp, b, a, surface) / a.z();
    EXPECT_NEAR(there, back, 1e-4F * (there + back) + 1e-7F);
  }
}

TEST(Lobe, NeverGivesMoreThanItGets) {
  const SphereGrid fine(64);
  for (const float m : {0.1F, 0.3F, 0.6F}) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0, 88.0}) {
      const double energy = integral(tilted(angle), {m, 0.25F, 1.0F}, fine);
      EXPECT_LE(energy, 1.002) << m << ' ' << angle;  // the grid adds up a lobe of m = .1 to 1e-3
      if (m < 0.2F && angle < 50) {
        EXPECT_GT(energy, 0.97);  // an ideal mirror that is nearly smooth keeps nearly all
      }
    }
  }
}

TEST(LobeSampler, DrawsByItsDensity) {
  const float roughness = 0.35F;
  const Eigen::Vector3f view = tilted(50);
  const SphereGrid coarse(3);
  const SphereGrid fine(48);
  std::vector<double> expected(static_cast<std::size_t>(coarse.cell_count()) + 1, 0.0);
  for (int c = 0; c < fine.cell_count(); ++c) {
    expected[static_cast<std::size_t>(coarse.cell_of(fine.direction(c)))] +=
        static_cast<double>(lobe_density(kUp, view, fine.direction(c), roughness)) * fine.cell_solid_angle();
  }
  double inside = 0;
  for (const double share : expected) inside += share;
  expected.back() = 1 - inside;  // half vectors that the viewer sees from behind
  EXPECT_GE(expected.back(), -1e-3);

  constexpr int kDraws = 100000;
  std::vector<double> drawn(expected.size(), 0.0);
  Random random({5});
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    const Eigen::Vector3f light = sample_lobe(kUp, view, roughness, u, random.uniform());
    if (light.isZero()) {
      drawn.back() += 1;
    } else {
      drawn[static_cast<std::size_t>(coarse.cell_of(light))] += 1;
    }
  }
  double chi2 = 0;
  int bins = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double count = kDraws * expected[k];
    if (count < 20) continue;  // too few for the statistic
    chi2 += (drawn[k] - count) * (drawn[k] - count) / count;
    ++bins;
  }
  ASSERT_GT(bins, 20);
  // Mean bins - 1, variance twice that; 5 deviations happen once in a million seeds.
  EXPECT_LT(chi2, bins - 1 + 5 * std::sqrt(2.0 * (bins - 1)));
}

// Row sums are the lobe's integral over what is free; on a ball that is the whole hemisphere.
void expect_rows_like_monte_carlo(float roughness, double tolerance) {
  const float f0 = 0.04F;
  const Stage stage =
      make_stage(scene_of({ball(0.1F, 60)}), camera_at(1.0F, 0.12F, 24), roughness, {.bounce_rays = 0}, f0);
  Fragments seen = stage.view.fragments;
  seen.slope_variance.resize(0);  // the lobe as it is, not as pixels of a tenth of the ball see it
  const Eigen::Index count = seen.count();
  const ViewTransport view_transport = build_view_transport(
      stage.scene, stage.transport, std::move(seen),
      {stage.view.surface.normal, Eigen::VectorXf::Constant(count, roughness), Eigen::VectorXf::Constant(count, f0)},
      stage.view.camera_position, {});
  const Eigen::VectorXf sums = view_transport.specular.row_sums();
  for (const float x : {0.0F, 0.03F, 0.06F, 0.08F}) {
    const int i = fragment_at(stage, {x, 0, std::sqrt(0.01F - x * x)});
    const Eigen::Vector3f normal = stage.view.surface.normal.row(i).transpose();
    const Eigen::Vector3f view =
        (Eigen::Vector3f(0, 0, 1) - stage.view.fragments.position.row(i).transpose()).normalized();
    Random random({6, static_cast<std::uint64_t>(i)});
    constexpr int kDraws = 40000;
    double sum = 0;
    for (int k = 0; k < kDraws; ++k) {
      const double u = random.uniform();
      const Eigen::Vector3f light = sample_lobe(normal, view, roughness, u, random.uniform());
      const float density = light.isZero() ? 0.0F : lobe_density(normal, view, light, roughness);
      if (density > 0) sum += static_cast<double>(specular_lobe(normal, view, light, {roughness, 1.0F, f0}) / density);
    }
    EXPECT_NEAR(sums(i), sum / kDraws, tolerance * sum / kDraws) << roughness << ' ' << x;
  }
}

// The weights of the draws spread by about their own mean at worst, so 40,000 of them are good to 0.5 %; the cells add up a lobe of
// m >= .12 to 0.2 %, and with 16 parts each one of m = .03 to 1 %.
TEST(ViewTransport, RoughRowsAgreeWithMonteCarlo) { expect_rows_like_monte_carlo(0.3F, 0.01); }
TEST(ViewTransport, MiddlingRowsAgreeWithMonteCarlo) { expect_rows_like_monte_carlo(0.12F, 0.01); }
TEST(ViewTransport, SmoothRowsAgreeWithMonteCarlo) { expect_rows_like_monte_carlo(0.05F, 0.015); }
TEST(ViewTransport, VerySmoothRowsAgreeWithMonteCarlo) { expect_rows_like_monte_carlo(0.02F, 0.02); }

TEST(ViewTransport, OneCellGivesTheLobe) {
  const Stage stage = make_stage(scene_of({ball(0.1F, 60)}), camera_at(1.0F, 0.12F, 32), 0.35F);
  const SphereGrid grid(16);
  const int cell = grid.cell_of({0.4F, 0.3F, 0.8F});
  LightSample light = even_light(stage, 0);
  light.cells.row(cell).setConstant(7);
  const FragmentLight out = light_up(stage, light);
  int bright = 0;
  for (int i = 0; i < stage.view.fragments.count(); ++i) {
    const Eigen::Vector3f view =
        (Eigen::Vector3f(0, 0, 1) - stage.view.fragments.position.row(i).transpose()).normalized();
    const Eigen::Vector3f normal = stage.view.surface.normal.row(i).transpose();
    if (normal.dot(grid.direction(cell)) < 0.1F) continue;  // the cell sets there, seen by some vertices only
    const float expected =
        7 * static_cast<float>(grid.cell_solid_angle()) *
        specular_lobe(normal, view, grid.direction(cell), {stage.view.surface.roughness(i), 1.0F, 0.04F});
    EXPECT_NEAR(out.specular(i, 1), expected, 1e-3F * expected + 1e-6F);
    bright += expected > 1e-3F ? 1 : 0;
  }
  EXPECT_GT(bright, 50);
}

}  // namespace
}  // namespace faceprobe::synth
