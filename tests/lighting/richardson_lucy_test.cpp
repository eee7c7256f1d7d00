#include "faceprobe/lighting/richardson_lucy.h"

#include "synthetic_face.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

using testing::ellipsoid_face;
using testing::lamp;
using testing::light_up;

struct Problem {
  SphereGrid grid{8};
  Observations face = ellipsoid_face(24);
  RowMatrix transport = build_transport(face, grid).highlight();
  Eigen::MatrixXf start = Eigen::MatrixXf::Constant(grid.cell_count(), 3, 0.5F);
};

TEST(RichardsonLucy, EstimateIsNonNegativeFluxIsKeptAndLikelihoodNeverFalls) {
  Problem p;
  light_up(p.face, p.grid, lamp(p.grid, {0.5, 0.4, 1}, 8, 0.1F), 0.2F);
  const RichardsonLucyResult result =
      richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, p.start,
                      {.iterations = 60, .unobserved_share = 0, .track_likelihood = true});
  EXPECT_GE(result.estimate.minCoeff(), 0.0F);
  // Every step makes the weighted sum of predictions equal that of the data, in exact arithmetic; floats leave 1e-5.
  for (int c = 0; c < 3; ++c) {
    const double predicted = (p.transport * result.estimate.col(c)).cast<double>().sum();
    EXPECT_NEAR(predicted / p.face.highlight.col(c).cast<double>().sum(), 1.0, 1e-3);
  }
  ASSERT_EQ(result.log_likelihood.size(), 61U);
  for (std::size_t i = 1; i < result.log_likelihood.size(); ++i) {
    EXPECT_GE(result.log_likelihood[i], result.log_likelihood[i - 1] - 1e-6 * std::abs(result.log_likelihood[i - 1]))
        << i;
  }
}

TEST(RichardsonLucy, TrueLightIsAFixedPoint) {
  Problem p;
  const Eigen::MatrixX3f truth = lamp(p.grid, {-0.3, 0.6, 0.8}, 15, 0.2F);
  light_up(p.face, p.grid, truth);
  const RichardsonLucyResult result =
      richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, truth, {.iterations = 20});
  EXPECT_LE((result.estimate - truth).cwiseAbs().maxCoeff(), 1e-3F * truth.maxCoeff());
}

TEST(RichardsonLucy, UniformLightComesBackUniform) {
  Problem p;
  light_up(p.face, p.grid, Eigen::MatrixX3f::Constant(p.grid.cell_count(), 3, 2.0F));
  const RichardsonLucyResult result =
      richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, p.start, {.iterations = 100});
  const float most = result.sensitivity.maxCoeff();
  for (int j = 0; j < p.grid.cell_count(); ++j) {
    // Well observed cells: the first step already lands on the uniform solution, up to float rounding.
    if (result.sensitivity[j] > 0.01F * most) {
      EXPECT_NEAR(result.estimate(j, 0), 2.0F, 2e-3F);
    }
  }
}

TEST(RichardsonLucy, UnobservedColumnsKeepTheirStart) {
  Problem p;
  light_up(p.face, p.grid, lamp(p.grid, {0, 0, 1}, 10, 0.1F));
  const RichardsonLucyResult result = richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, p.start,
                                                      {.iterations = 10, .unobserved_share = 1e-2F});
  const int behind = p.grid.cell_of({0, 0, -1});
  EXPECT_LT(result.sensitivity[behind], 1e-2F * result.sensitivity.maxCoeff());
  EXPECT_EQ(result.estimate(behind, 0), 0.5F);
}

TEST(RichardsonLucy, LowerBoundsPullUpButNotDown) {
  // Two unknowns, each seen by one row. The first datum is a bound below the start: silent. The second is above: pulls.
  const RowMatrix identity = RowMatrix::Identity(2, 2);
  Eigen::MatrixXf data(2, 1);
  data << 1.0F, 5.0F;
  Eigen::MatrixXf start(2, 1);
  start << 3.0F, 3.0F;
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> bound(2, 1);
  bound << true, true;
  const Eigen::VectorXf weight = Eigen::VectorXf::Ones(2);
  const RichardsonLucyResult result = richardson_lucy(identity, weight, data, bound, start, {.iterations = 5});
  EXPECT_FLOAT_EQ(result.estimate(0, 0), 3.0F);
  EXPECT_FLOAT_EQ(result.estimate(1, 0), 5.0F);
}

TEST(RichardsonLucy, PriorHoldsWhatIsHardlyObserved) {
  // Three unknowns, one row each; the median weight is 1. A column of weight w < 1 has beta = b (1 - w) and the fixed point
  // e = (w h + beta start) / (w + beta); the others follow their data.
  const RowMatrix identity = RowMatrix::Identity(3, 3);
  const Eigen::MatrixXf data = Eigen::MatrixXf::Constant(3, 1, 4.0F);
  const Eigen::MatrixXf start = Eigen::MatrixXf::Ones(3, 1);
  Eigen::VectorXf weight(3);
  weight << 1.0F, 0.01F, 2.0F;
  const RichardsonLucyResult result =
      richardson_lucy(identity, weight, data, {}, start, {.iterations = 30, .prior_weight = 0.1F});
  const float beta = 0.1F * 0.99F;
  EXPECT_NEAR(result.estimate(0, 0), 4.0F, 1e-5F);
  EXPECT_NEAR(result.estimate(1, 0), (0.01F * 4 + beta) / (0.01F + beta), 1e-5F);
  EXPECT_NEAR(result.estimate(2, 0), 4.0F, 1e-5F);
}

TEST(RichardsonLucy, ZeroAndHugeDataStayFinite) {
  Problem p;
  p.face.highlight.setZero(p.face.count(), 3);
  p.face.highlight(3, 0) = 1e20F;
  const RichardsonLucyResult result =
      richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, p.start, {.iterations = 200});
  EXPECT_TRUE(result.estimate.allFinite());
  EXPECT_GE(result.estimate.minCoeff(), 0.0F);
}

TEST(RichardsonLucy, BitwiseTheSameForAnyNumberOfThreads) {
  Problem p;
  light_up(p.face, p.grid, lamp(p.grid, {0.5, 0.4, 1}, 8, 0.1F), 0.1F);
  const auto run = [&](int threads) {
    return richardson_lucy(p.transport, p.face.weight, p.face.highlight, {}, p.start,
                           {.iterations = 15, .threads = threads})
        .estimate;
  };
  const Eigen::MatrixXf one = run(1);
  EXPECT_TRUE(one == run(2));
  EXPECT_TRUE(one == run(5));
}

TEST(RichardsonLucy, RefusesShapesThatDoNotMatch) {
  const RowMatrix identity = RowMatrix::Identity(2, 2);
  const Eigen::VectorXf weight = Eigen::VectorXf::Ones(3);
  const Eigen::MatrixXf data = Eigen::MatrixXf::Ones(2, 1);
  EXPECT_THROW(richardson_lucy(identity, weight, data, {}, data, {}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting
