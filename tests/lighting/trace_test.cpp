#include "faceprobe/lighting/trace.h"

#include "synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

TEST(Trace, ConstantHighlightsGiveAConstantMap) {
  const SphereGrid grid(16);
  const Observations face = testing::ellipsoid_face(40);
  const TracedMap traced = trace_highlights(face, Eigen::MatrixX3f::Constant(face.count(), 3, 0.7F), grid);
  ASSERT_GT(traced.weight.sum(), 0.4F * static_cast<float>(grid.cell_count()));
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (traced.weight[j] > 0) {
      EXPECT_NEAR(traced.value(j, 0), 0.7F, 1e-5F);
    }
  }
}

TEST(Trace, OptionsThatMeanNothingAreRefused) {
  const SphereGrid grid(2);
  const Observations face = testing::ellipsoid_face(10);
  for (const TraceOptions wrong : {TraceOptions{.neighbours = 0}, TraceOptions{.max_normal_gap_deg = -1},
                                   TraceOptions{.max_normal_gap_deg = std::nanf("")}}) {
    EXPECT_NE(wrong.validate(), "");
    EXPECT_THROW(trace_highlights(face, face.highlight, grid, wrong), std::invalid_argument);
  }
}

TEST(Trace, ValueGoesToTheMirrorDirection) {
  const SphereGrid grid(16);
  const Observations face = testing::ellipsoid_face(40);
  Eigen::MatrixX3f highlight = Eigen::MatrixX3f::Zero(face.count(), 3);
  const Eigen::RowVector3f normal = direction_from_angles(25, -10).transpose().cast<float>();
  for (Eigen::Index i = 0; i < face.count(); ++i) {
    if (face.normal.row(i).dot(normal) > std::cos(radians(6))) highlight.row(i).setOnes();
  }
  const TracedMap traced = trace_highlights(face, highlight, grid);
  const Eigen::Vector3d n = normal.transpose().cast<double>();
  const Eigen::Vector3d mirrored = 2 * n.z() * n - Eigen::Vector3d::UnitZ();
  for (int j = 0; j < grid.cell_count(); ++j) {
    const double angle = angle_between_deg(grid.direction(j).cast<double>(), mirrored);
    // A cap of 6 degrees of normals is one of 12 in mirror directions; the interpolation reaches a patch (3 deg) further.
    if (angle < 5) {
      EXPECT_GT(traced.value(j, 0), 0.9F);
    } else if (angle > 22) {
      EXPECT_LT(traced.value(j, 0), 0.1F);
    }
  }
}

TEST(Trace, DirectionsNoNormalMirrorsStayUnobserved) {
  const SphereGrid grid(8);
  const Observations face = testing::ellipsoid_face(40);
  const TracedMap traced = trace_highlights(face, face.highlight, grid);
  EXPECT_EQ(traced.weight[grid.cell_of({0, 0, -1})], 0.0F);
  EXPECT_EQ(traced.weight[grid.cell_of({0, 0, 1})], 1.0F);
}

}  // namespace
}  // namespace faceprobe::lighting
