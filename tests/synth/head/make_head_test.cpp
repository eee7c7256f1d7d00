#include "faceprobe/synth/procedural_head.h"
#include "small_head.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace faceprobe::synth {
namespace {

const SurfaceMesh& mesh_of(const Head& head, Material material) {
  for (const SurfaceMesh& mesh : head.figure.meshes) {
    if (mesh.material == material) return mesh;
  }
  throw std::logic_error("the head has no such mesh");
}

TEST(MakeHead, NoParametersGiveTheNeutralShapeSplitByMaterial) {
  const HeadModel model = small_head();
  const Head head = make_head(model, {});
  ASSERT_EQ(head.figure.meshes.size(), 2U);
  const SurfaceMesh& skin = mesh_of(head, Material::kSkin);
  EXPECT_EQ(skin.vertices, model.neutral);  // all seven are on skin
  EXPECT_EQ(skin.triangles, model.triangles.topRows(3));
  EXPECT_EQ(skin.uv, model.uv);
  EXPECT_EQ(skin.vertex_region, model.vertex_region);

  const SurfaceMesh& eye = mesh_of(head, Material::kEye);
  ASSERT_EQ(eye.vertices.rows(), 3);  // 1, 4 and 5, in that order
  EXPECT_EQ(eye.vertices.row(0), model.neutral.row(1));
  EXPECT_EQ(eye.vertices.row(1), model.neutral.row(4));
  EXPECT_EQ(eye.vertices.row(2), model.neutral.row(5));
  EXPECT_EQ(eye.triangles, (Eigen::MatrixX3i(1, 3) << 2, 1, 0).finished());
  EXPECT_EQ(eye.vertex_region, (std::vector<Region>{Region::kCheeks, Region::kNose, Region::kCheeks}));
  ASSERT_EQ(eye.uv.rows(), 3);  // 1, 2 and 3
  EXPECT_EQ(eye.triangle_uv, (Eigen::MatrixX3i(1, 3) << 2, 1, 0).finished());
  EXPECT_EQ(eye.uv.row(2), model.uv.row(3));
}

TEST(MakeHead, ModesAddUpAndShortOnesMoveTheFirstVertices) {
  const HeadModel model = small_head();
  HeadParameters parameters;
  parameters.identity = Eigen::Vector2f(2, 1);
  parameters.expression = Eigen::VectorXf::Constant(1, 0.5F);
  const Eigen::MatrixX3f moved = mesh_of(make_head(model, parameters), Material::kSkin).vertices - model.neutral;
  // Powers of two: exact in float.
  EXPECT_EQ(moved.topRows(2), Eigen::MatrixX3f::Constant(2, 3, 2 * 0.25F - 0.5F + 0.5F * 0.125F));
  EXPECT_EQ(moved.bottomRows(5), Eigen::MatrixX3f::Constant(5, 3, 2 * 0.25F + 0.5F * 0.125F));
}

TEST(MakeHead, MoreWeightsThanModesBreakTheContract) {
  HeadParameters parameters;
  parameters.identity = Eigen::VectorXf::Zero(3);
  EXPECT_THROW(make_head(small_head(), parameters), std::invalid_argument);
}

TEST(MakeHead, SeamsAndBordersOfPartsShowNoCrease) {
  const Head head = make_head(small_head(), {});
  const SurfaceMesh& skin = mesh_of(head, Material::kSkin);
  // The tip is met by four equal faces, however the file splits it: its normal is the axis. 1e-6: float rounding of unit vectors.
  EXPECT_LE((skin.normals.row(0) - Eigen::RowVector3f(0, 0, 1)).norm(), 1e-6F);
  EXPECT_LE((skin.normals.row(5) - skin.normals.row(0)).norm(), 1e-6F);
  EXPECT_LE((skin.normals.row(6) - skin.normals.row(2)).norm(), 1e-6F);
  // Corner 1 lies between skin (+x) and eye (-y): both have the same normal there.
  EXPECT_LE((mesh_of(head, Material::kEye).normals.row(0) - skin.normals.row(1)).norm(), 1e-6F);
}

TEST(MakeHead, SurfacesThatTouchFaceToFaceKeepTheirNormals) {
  HeadModel model = small_head();
  // The eye turned over: it now lies on the pyramid's inside and shares place, not direction, with the skin.
  model.triangles.row(3) << 5, 1, 4;
  model.neutral.conservativeResize(10, 3);
  for (int corner = 0; corner < 3; ++corner) {
    model.neutral.row(7 + corner) = model.neutral.row(model.triangles(2, corner));
    model.triangles(3, corner) = 9 - corner;
  }
  model.vertex_region.resize(10, Region::kEyes);
  model.identity.clear();
  model.expression.clear();
  const Head head = make_head(model, {});
  const Eigen::RowVector3f inwards = Eigen::RowVector3f(1, 0, -1).normalized();
  for (const auto& normal : mesh_of(head, Material::kEye).normals.rowwise())
    EXPECT_LE((normal - inwards).norm(), 1e-6F);
}

TEST(MakeHead, NormalsAreOfUnitLengthOnADeformedFace) {
  const HeadModel model = procedural_head();
  Random random({5});
  HeadParameters parameters = draw_identity(model, {}, random);
  parameters.expression = draw_expression(model, {.neutral_share = 0}, random);
  for (const SurfaceMesh& mesh : make_head(model, parameters).figure.meshes) {
    EXPECT_LE((mesh.normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-6F);  // float rounding
    EXPECT_EQ(mesh.vertex_region.size(), static_cast<std::size_t>(mesh.vertices.rows()));
  }
}

TEST(MakeHead, LandmarksAndSurfacePointsMoveWithTheHead) {
  HeadModel model = small_head();
  model.landmarks.assign(68, 3);
  SurfacePoint middle{2, Eigen::Vector3f(0.5F, 0.25F, 0.25F)};
  model.dense_landmarks.assign(468, middle);
  ASSERT_EQ(model.validate(), "");
  HeadParameters parameters;
  parameters.identity = Eigen::VectorXf::Constant(1, 4.0F);  // everything by (1, 1, 1)
  const Head head = make_head(model, parameters);
  ASSERT_EQ(head.landmarks.rows(), 68);
  ASSERT_EQ(head.dense_landmarks.rows(), 468);
  EXPECT_EQ(head.landmarks.row(67), Eigen::RowVector3f(0, 2, 1));
  // Half the tip (0, 0, 1), a quarter each of (-1, 1, 0) and (-1, -1, 0).
  EXPECT_EQ(head.dense_landmarks.row(467), Eigen::RowVector3f(0.5F, 1.0F, 1.5F));
}

TEST(MakeHead, AlbedoModesStayWithinReflectance) {
  HeadModel model = small_head();
  model.vertex_albedo = Eigen::MatrixX3f::Constant(7, 3, 0.5F);
  model.albedo_modes = {Eigen::MatrixX3f::Constant(7, 3, 0.25F)};
  HeadParameters parameters;
  parameters.albedo = Eigen::VectorXf::Constant(1, 1.0F);
  EXPECT_EQ(mesh_of(make_head(model, parameters), Material::kSkin).vertex_albedo,
            Eigen::MatrixX3f::Constant(7, 3, 0.75F));
  parameters.albedo(0) = -3;
  EXPECT_EQ(mesh_of(make_head(model, parameters), Material::kSkin).vertex_albedo, Eigen::MatrixX3f::Zero(7, 3));
}

}  // namespace
}  // namespace faceprobe::synth
