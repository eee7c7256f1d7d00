#include "faceprobe/lighting/face_features.h"

#include "faceprobe/core/sphere_grid.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>

namespace faceprobe::lighting {
namespace {

Observations lit_face(const Eigen::Vector3d& towards, int across = 40) {
  const SphereGrid grid(16);
  Observations face = testing::ellipsoid_face(across);
  testing::light_up(face, grid, testing::lamp(grid, towards, 8, 0.05F, {1.2F, 1, 0.8F}));
  return face;
}

Eigen::Vector4f cell_of(const Eigen::VectorXf& features, int half, const Eigen::Vector3f& direction) {
  const SphereGrid grid(kFeatureNside);
  return features.segment<4>(4 * (half * kFeatureCells + grid.cell_of(direction)));
}

TEST(FaceFeatures, HoldShadingByNormalAndHighlightsByMirrorDirection) {
  Observations face = testing::ellipsoid_face();
  face.shading.setConstant(2);
  face.highlight.setConstant(0.5F);
  const Eigen::VectorXf features = face_features(face);
  const Eigen::Vector4f shading = cell_of(features, 0, {0, 0, 1});
  // Shading is its own level: 1, a little less for what is not known.
  EXPECT_NEAR(shading[1], std::sqrt(shading[3]), 1e-5F);
  EXPECT_GT(shading[3], 0.5F);
  // A quarter of the level; to the side, where a normal half as far mirrors.
  const Eigen::Vector4f highlight = cell_of(features, 1, {0.8F, 0, 0.3F});
  EXPECT_NEAR(highlight[0], std::sqrt(3 * 0.25F * highlight[3]), 1e-5F);
  EXPECT_GT(highlight[3], 0.3F);
  // Nothing faces away from the camera.
  EXPECT_LT(cell_of(features, 0, {0, 0, -1})[3], 1e-3F);
}

TEST(FaceFeatures, HaveTheOpenShadingWhereItIsKnown) {
  Observations face = testing::ellipsoid_face();
  face.shading.setConstant(2);
  // Without one, the shading stands for it.
  const Eigen::VectorXf without = face_features(face);
  EXPECT_EQ(cell_of(without, 2, {0, 0, 1}), cell_of(without, 0, {0, 0, 1}));
  face.open_shading.setConstant(face.count(), 3, 3);
  const Eigen::VectorXf features = face_features(face);
  const Eigen::Vector4f open = cell_of(features, 2, {0, 0, 1});
  EXPECT_NEAR(open[1], std::sqrt(1.5F * open[3]), 1e-5F);
  EXPECT_EQ(cell_of(features, 0, {0, 0, 1}), cell_of(without, 0, {0, 0, 1}));
}

TEST(FaceFeatures, TheScaleOfTheLightDoesNotMatter) {
  Observations face = lit_face({1, 1, 1});
  const Eigen::VectorXf once = face_features(face);
  const float level = shading_level(face);
  face.shading *= 5;
  face.highlight *= 5;
  EXPECT_LT((face_features(face) - once).cwiseAbs().maxCoeff(), 1e-4F);  // float
  EXPECT_NEAR(shading_level(face), 5 * level, 1e-3F * level);
}

// As many patches again say the same.
TEST(FaceFeatures, HardlyDependOnTheNumberOfPatches) {
  const Eigen::VectorXf few = face_features(lit_face({1, 0.5, 1}, 30));
  const Eigen::VectorXf many = face_features(lit_face({1, 0.5, 1}, 60));
  EXPECT_LT((few - many).norm() / many.norm(), 0.05F);
}

TEST(FaceFeatures, AMirroredFaceHasMirroredFeatures) {
  Observations face = lit_face({1, 0.5, 1});
  const Eigen::VectorXf features = face_features(face);
  face.normal.col(0) *= -1;
  face.view.col(0) *= -1;
  const Eigen::VectorXf other = face_features(face);
  EXPECT_LT((other - mirrored_features(features)).cwiseAbs().maxCoeff(), 1e-4F);
  EXPECT_GT((other - features).cwiseAbs().maxCoeff(), 0.1F);
  EXPECT_EQ(mirrored_features(mirrored_features(features)), features);
}

// Cells are 15 degrees wide, and what is found is smooth.
TEST(FaceFeatures, EndWithTheLightThatTheSolverFinds) {
  const Eigen::Vector3f towards = Eigen::Vector3f(0.5F, 0.4F, 1).normalized();
  const Eigen::VectorXf features = face_features(lit_face({towards.x(), towards.y(), towards.z()}));
  using Solved = Eigen::Matrix<float, kFeatureCells, 3, Eigen::RowMajor>;
  const Solved solved(features.data() + kCellFeatures);
  EXPECT_GE(solved.minCoeff(), 0);
  Eigen::Index brightest = 0;
  solved.col(1).maxCoeff(&brightest);
  EXPECT_GT(SphereGrid(kFeatureNside).direction(static_cast<int>(brightest)).dot(towards), 0.9F);  // 26 degrees
  EXPECT_GT(solved(brightest, 0), solved(brightest, 2));                                           // a warm lamp
}

TEST(FaceFeatures, CellsMirrorAsTheirDirectionsDo) {
  const Eigen::MatrixXf directions = SphereGrid(kFeatureNside).directions();
  Eigen::MatrixXf expected = directions;
  expected.col(0) *= -1;
  EXPECT_LT((mirrored_cells(directions) - expected).cwiseAbs().maxCoeff(), 1e-5F);
}

TEST(FaceFeatures, WithoutLightThereIsNothing) {
  Observations face = testing::ellipsoid_face();
  EXPECT_TRUE(face_features(face).isZero());
  face.shading.setOnes();
  face.clipped.setConstant(true);
  EXPECT_EQ(shading_level(face), 0);
  EXPECT_TRUE(face_features(face).isZero());
}

}  // namespace
}  // namespace faceprobe::lighting
