#include "synth/skin/noise.h"
#include "synth/skin/skin_fixture.h"

#include <gtest/gtest.h>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr int kPoints = 60000;

Eigen::MatrixX3f random_normals(int count) {
  Random random({9});
  Eigen::MatrixX3f normals(count, 3);
  for (int i = 0; i < count; ++i) normals.row(i) = random.direction().transpose();
  return normals;
}

// Mean squared slope per axis of disturbed against undisturbed normals.
double slope_variance(const Eigen::MatrixX3f& disturbed, const Eigen::MatrixX3f& smooth) {
  double sum = 0;
  for (Eigen::Index i = 0; i < smooth.rows(); ++i) {
    const double cosine = static_cast<double>(disturbed.row(i).dot(smooth.row(i)));
    sum += (1.0 - cosine * cosine) / (cosine * cosine);
  }
  return 0.5 * sum / static_cast<double>(smooth.rows());
}

TEST(PoreNormals, AreUnitLengthWithTheSlopeAskedForWherePixelsAreSmall) {
  SkinSettings settings;
  settings.pore_slope = 0.08F;
  settings.seed = 3;
  const Eigen::MatrixX3f normals = random_normals(kPoints);
  const SkinPoints points = testing::scattered_points(kPoints, 5);
  const PoreNormals pores =
      pore_normals(settings, points.rest_position, normals, Eigen::VectorXf::Constant(kPoints, 1e-6F));
  EXPECT_LE((pores.normal.rowwise().norm().array() - 1.0F).abs().maxCoeff(), 1e-6F);  // float
  // 60,000 independent pairs of squared slopes, whose kurtosis is under 10: 1 % at two deviations. Plus float cosines: 1e-7 / .0032.
  EXPECT_NEAR(2 * slope_variance(pores.normal, normals) / (0.08 * 0.08), 1.0, 0.025);
  EXPECT_LE(pores.added_slope_variance.cwiseAbs().maxCoeff(), 1e-6F * 0.0064F + 1e-8F);
}

TEST(PoreNormals, VisibleAndAddedSlopeTogetherAreWhatIsAskedForAtEveryPixelSize) {
  SkinSettings settings;
  settings.pore_slope = 0.1F;
  settings.pore_size_m = 0.001F;
  const Eigen::MatrixX3f normals = random_normals(kPoints);
  const SkinPoints points = testing::scattered_points(kPoints, 6);
  double last = 1;
  for (const float footprint_m : {0.0001F, 0.0004F, 0.0008F, 0.003F}) {
    const PoreNormals pores =
        pore_normals(settings, points.rest_position, normals, Eigen::VectorXf::Constant(kPoints, footprint_m));
    const double visible = slope_variance(pores.normal, normals);
    const auto added = static_cast<double>(pores.added_slope_variance.mean());
    EXPECT_NEAR((visible + added) / (0.5 * 0.1 * 0.1), 1.0, 0.025) << footprint_m;  // as above
    EXPECT_LT(visible, last);
    last = visible;
  }
  EXPECT_LT(last, 1e-5);  // pixels three pores wide see none
}

TEST(PoreNormals, PaperSkinHasNone) {
  Random random({1});
  const Eigen::MatrixX3f normals = random_normals(10);
  const PoreNormals pores = pore_normals(draw_paper_skin(0, random), testing::scattered_points(10, 1).rest_position,
                                         normals, Eigen::VectorXf::Constant(10, 1e-4F));
  EXPECT_EQ(pores.normal, normals);
  EXPECT_EQ(pores.added_slope_variance.maxCoeff(), 0.0F);
}

TEST(SkinNoise, GradientIsUnitVarianceAndValueNoiseToo) {
  Random random({7});
  double gradient = 0;
  double value = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3f place(static_cast<float>(random.between(-500, 500)),
                                static_cast<float>(random.between(-500, 500)),
                                static_cast<float>(random.between(-500, 500)));
    gradient += static_cast<double>(noise_gradient(place, 1).squaredNorm()) / 3;
    const auto v = static_cast<double>(value_noise(place, 2));
    value += v * v;
  }
  // Standard errors are under 0.5 %.
  EXPECT_NEAR(gradient / kDraws, 1.0, 0.015);
  EXPECT_NEAR(value / kDraws, 1.0, 0.015);
}

}  // namespace
}  // namespace faceprobe::synth
