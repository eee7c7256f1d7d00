#include "faceprobe/synth/procedural_head.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace faceprobe::synth {
namespace {

TEST(ProceduralHead, IsAValidModelWithAllParts) {
  const HeadModel model = procedural_head();
  EXPECT_EQ(model.validate(), "");
  EXPECT_EQ(model.landmarks.size(), 68U);
  EXPECT_EQ(std::set<int>(model.landmarks.begin(), model.landmarks.end()).size(), 68U);  // all of them different vertices
  std::set<Material> materials;
  for (const SurfaceMesh& mesh : make_head(model, {}).figure.meshes) materials.insert(mesh.material);
  EXPECT_EQ(materials, (std::set<Material>{Material::kSkin, Material::kEye, Material::kMouth, Material::kTeeth}));
}

TEST(ProceduralHead, IsTheSizeOfAHeadAndFacesForward) {
  const HeadModel model = procedural_head();
  const Eigen::MatrixX3f marks = make_head(model, {}).landmarks;
  EXPECT_LE(marks.middleRows(36, 12).colwise().mean().norm(), 1e-6F);  // the origin; float rounding
  // Adults' means: pupils 63 mm apart, outer corners of the eyes 89 mm, chin 110 to 120 mm below the eyes.
  EXPECT_NEAR((marks.row(45) - marks.row(36)).norm(), 0.092F, 0.005F);
  EXPECT_NEAR(marks(8, 1), -0.115F, 0.006F);
  EXPECT_LT(marks(36, 0), 0);  // the subject's right is -x
  EXPECT_GT(marks(30, 2), marks(8, 2));
  EXPECT_GT(marks(30, 2), marks(27, 2));
  for (int i = 0; i < 17; ++i)
    EXPECT_NEAR(marks(i, 0), -marks(16 - i, 0), 0.004F) << i;  // as even as the grid, 4 mm there
}

// Edges that only one triangle has, or that two run through in the same direction.
TEST(ProceduralHead, SkinAndMouthAreOneSurfaceThatEndsAtTheNeck) {
  const HeadModel model = procedural_head();
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < model.triangles.rows(); ++t) {
    const Material material = model.triangle_material[static_cast<std::size_t>(t)];
    if (material != Material::kSkin && material != Material::kMouth) continue;
    for (int corner = 0; corner < 3; ++corner) {
      ++edges[{model.triangles(t, corner), model.triangles(t, (corner + 1) % 3)}];
    }
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    const bool at_border = edges.count({edge.second, edge.first}) == 0;
    EXPECT_TRUE(!at_border || model.neutral(edge.first, 1) < -0.2F);
  }
}

TEST(ProceduralHead, SurfaceFacesOutwards) {
  const HeadModel model = procedural_head();
  const Eigen::RowVector3f inside(0, -0.02F, -0.07F);
  for (const SurfaceMesh& mesh : make_head(model, {}).figure.meshes) {
    if (mesh.material != Material::kSkin) continue;
    int outwards = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
      outwards += mesh.normals.row(v).dot(mesh.vertices.row(v) - inside) > 0 ? 1 : 0;
    // All but the undersides of nose, lips, brows and ears.
    EXPECT_GT(outwards, 0.9 * static_cast<double>(mesh.vertices.rows()));
  }
}

TEST(ProceduralHead, ExpressionsMoveWhatTheyName) {
  const HeadModel model = procedural_head();
  const auto marks = [&](const std::string& name) -> Eigen::MatrixX3f {
    HeadParameters parameters;
    parameters.expression = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(model.expression.size()));
    const auto at = std::ranges::find(model.expression_names, name) - model.expression_names.begin();
    parameters.expression(at) = 1;
    return make_head(model, parameters).landmarks - make_head(model, {}).landmarks;
  };
  EXPECT_LT(marks("jawOpen")(57, 1), -0.010F);               // the lower lip by a centimetre and more
  EXPECT_NEAR(marks("jawOpen")(51, 1), 0, 0.001F);           // the upper one stays
  EXPECT_GT(marks("mouthSmile_L")(54, 1), 0.003F);           // left corner
  EXPECT_LT(marks("mouthSmile_L").row(48).norm(), 0.0005F);  // not the right one
  EXPECT_GT(marks("browInnerUp")(19, 1), 0.003F);
  EXPECT_GT(marks("eyeBlink_L").middleRows(43, 2).rowwise().norm().maxCoeff(), 0.0005F);
  EXPECT_LT(marks("eyeBlink_L").middleRows(36, 6).norm(), 1e-6F);
}

}  // namespace
}  // namespace faceprobe::synth
