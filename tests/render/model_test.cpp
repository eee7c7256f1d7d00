#include "faceprobe/render/model.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/vertex_normals.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace faceprobe::render {
namespace {

using faceprobe::testing::expect_error;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kRounding = 1e-5F;  // a few operations on numbers up to 10

bool mentions(const std::string& sentence, const std::string& word) {
  return sentence.find(word) != std::string::npos && sentence.back() == '.';
}

// In the plane z = 0, towards +z.
Model one_triangle() {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 2, 0;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  mesh.normals = vertex_normals(mesh.vertices, mesh.triangles);
  return {{std::move(mesh)}, {material_preset("clay")}};
}

// Of a box 2 x 4 x 6 whose underside's middle is at (1, 10, 3), the top, the underside, and a mark on the side that faces +z.
Model points_of_a_box() {
  Model model = one_triangle();
  TriangleMesh& mesh = model.meshes[0];
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 10, 0, 2, 10, 0, 1, 14, 3, 1, 10, 6;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 2, 1, 0, 3, 2;
  mesh.normals = Eigen::RowVector3f(0, 0, 1).replicate(4, 1);
  return model;
}

Eigen::Vector3f vertex(const Model& model, int row) { return model.meshes[0].vertices.row(row).transpose(); }
Eigen::Vector3f normal(const Model& model, int row) { return model.meshes[0].normals.row(row).transpose(); }

#define EXPECT_POINT(found, x, y, z) \
  EXPECT_LT(((found)-Eigen::Vector3f(x, y, z)).norm(), kRounding) << (found).transpose()

TEST(Model, CountsAndBounds) {
  const Model model = points_of_a_box();
  EXPECT_EQ(model.validate(), "");
  EXPECT_EQ(model.triangle_count(), 2);
  EXPECT_POINT(model.box().min(), 0, 10, 0);
  EXPECT_POINT(model.box().max(), 2, 14, 6);
  EXPECT_TRUE(Model{}.box().isEmpty());
}

TEST(Model, TransformMovesVerticesAndTurnsNormals) {
  Model model = one_triangle();
  Eigen::Affine3f world_from_model = Eigen::Affine3f::Identity();
  world_from_model.translate(Eigen::Vector3f(5, 6, 7));
  world_from_model.rotate(Eigen::AngleAxisf(static_cast<float>(radians(90)), Eigen::Vector3f::UnitY()));
  world_from_model.scale(3);
  transform(model, world_from_model);
  EXPECT_POINT(vertex(model, 0), 5, 6, 7);
  EXPECT_POINT(vertex(model, 1), 5, 6, 4);  // +x goes to -z, 3 long
  EXPECT_POINT(vertex(model, 2), 5, 12, 7);
  for (int k = 0; k < 3; ++k) EXPECT_POINT(normal(model, k), 1, 0, 0);
}

TEST(Model, NormalsStayUprightUnderUnevenScale) {
  Model model = one_triangle();
  model.meshes[0].vertices.row(1) = Eigen::RowVector3f(1, 0, 1);
  model.meshes[0].normals = vertex_normals(model.meshes[0].vertices, model.meshes[0].triangles);
  transform(model, Eigen::Affine3f(Eigen::Scaling(3.0F, 1.0F, 0.5F)));
  EXPECT_NEAR(normal(model, 0).dot(vertex(model, 1) - vertex(model, 0)), 0, kRounding);
  EXPECT_NEAR(normal(model, 0).norm(), 1, kRounding);
  EXPECT_GT(normal(model, 0).z(), 0);
}

TEST(Model, MirrorImageIsNotInsideOut) {
  Model model = one_triangle();
  transform(model, Eigen::Affine3f(Eigen::Scaling(-1.0F, 1.0F, 1.0F)));
  const Eigen::MatrixX3f geometric = vertex_normals(model.meshes[0].vertices, model.meshes[0].triangles);
  EXPECT_POINT(normal(model, 0), 0, 0, 1);
  EXPECT_POINT(geometric.row(0).transpose(), 0, 0, 1);
}

TEST(Model, PlacedUprightItsFrontFacesTheViewer) {
  Model model = points_of_a_box();
  place(model, {.height_m = 2, .foot_m = {-1, 0.5F, -4}});
  EXPECT_POINT(vertex(model, 2), -1, 2.5F, -4);  // top
  EXPECT_POINT(vertex(model, 3), -1, 0.5F, -2.5F);
  EXPECT_POINT(normal(model, 0), 0, 0, 1);
}

TEST(Model, PositiveTurnIsToTheViewersRight) {
  Model model = points_of_a_box();
  place(model, {.height_m = 4, .turn = static_cast<float>(radians(30))});
  EXPECT_POINT(vertex(model, 2), 0, 4, 0);
  EXPECT_POINT(vertex(model, 3), 3 * 0.5F, 0, 3 * 0.8660254F);
  EXPECT_POINT(normal(model, 0), 0.5F, 0, 0.8660254F);
}

TEST(Model, PlacedOnASlopeItStandsAtRightAngles) {
  Model model = points_of_a_box();
  const Eigen::Vector3f up(0, 0.8F, 0.6F);
  // Of another length, which does not count.
  place(model, {.height_m = 4, .foot_m = {1, 2, 3}, .up = 7 * up, .turn = static_cast<float>(radians(90))});
  EXPECT_POINT(vertex(model, 2), 1, 2 + 3.2F, 3 + 2.4F);
  // The tilt takes +z to (0, -.6, .8); a quarter turn about `up` takes that to +x.
  EXPECT_POINT(normal(model, 0), 1, 0, 0);
  EXPECT_POINT(vertex(model, 3), 1 + 3, 2, 3);
}

TEST(Model, PlacedUpsideDown) {
  Model model = points_of_a_box();
  place(model, {.height_m = 4, .up = -Eigen::Vector3f::UnitY()});
  EXPECT_POINT(vertex(model, 2), 0, -4, 0);
  EXPECT_NEAR(model.box().max().y(), 0, kRounding);
}

TEST(Model, WhatCannotBePlacedIsRefused) {
  Model nothing;
  EXPECT_THROW(place(nothing, {}), std::invalid_argument);
  Model flat = one_triangle();
  flat.meshes[0].vertices.col(1).setZero();
  EXPECT_THROW(place(flat, {}), std::invalid_argument);
  Model model = one_triangle();
  EXPECT_THROW(place(model, {.height_m = 0}), std::invalid_argument);
  EXPECT_THROW(place(model, {.height_m = kNan}), std::invalid_argument);
  EXPECT_THROW(place(model, {.up = Eigen::Vector3f::Zero()}), std::invalid_argument);
}

TEST(Model, ValidateNeedsATriangle) {
  EXPECT_TRUE(mentions(Model{}.validate(), "at least one triangle"));
  Model model = one_triangle();
  model.meshes[0].triangles.resize(0, 3);
  EXPECT_TRUE(mentions(model.validate(), "at least one triangle"));
}

TEST(Model, ValidateFindsIndicesOutOfRange) {
  Model model = one_triangle();
  model.meshes[0].triangles(0, 2) = 3;
  EXPECT_TRUE(mentions(model.validate(), "number 3"));
  model.meshes[0].triangles(0, 2) = -1;
  EXPECT_TRUE(mentions(model.validate(), "number -1"));
}

TEST(Model, ValidateFindsNumbersThatAreNone) {
  for (const float wrong : {kNan, kInfinity}) {
    Model model = one_triangle();
    model.meshes[0].vertices(1, 2) = wrong;
    EXPECT_TRUE(mentions(model.validate(), "vertices that are not finite"));
    model = one_triangle();
    model.meshes[0].normals(1, 2) = wrong;
    EXPECT_TRUE(mentions(model.validate(), "normals"));
    model = one_triangle();
    model.meshes[0].uv = Eigen::MatrixX2f::Constant(3, 2, wrong);
    EXPECT_TRUE(mentions(model.validate(), "texture points that are not finite"));
  }
}

TEST(Model, ValidateFindsNormalsThatAreNotUnit) {
  Model model = one_triangle();
  model.meshes[0].normals *= 1.005F;  // rounding in a file is no fault
  EXPECT_EQ(model.validate(), "");
  model.meshes[0].normals.row(2).setZero();
  EXPECT_TRUE(mentions(model.validate(), "unit length"));
}

TEST(Model, ValidateFindsRowsThatDoNotGoTogether) {
  Model model = one_triangle();
  model.meshes[0].normals.conservativeResize(2, 3);
  EXPECT_TRUE(mentions(model.validate(), "one normal per vertex, found 2 for 3"));
  model = one_triangle();
  model.meshes[0].uv.setZero(4, 2);
  EXPECT_TRUE(mentions(model.validate(), "one texture point per vertex, found 4 for 3"));
}

TEST(Model, ValidateFindsFaultsOfMaterials) {
  Model model = one_triangle();
  model.meshes[0].material = 1;
  EXPECT_TRUE(mentions(model.validate(), "material 1 of 1"));
  model.meshes[0].material = -1;
  EXPECT_TRUE(mentions(model.validate(), "material -1 of 1"));
  model = one_triangle();
  model.materials[0].roughness = 2;
  EXPECT_TRUE(mentions(model.validate(), "'clay'"));
  EXPECT_TRUE(mentions(model.validate(), "roughness"));
}

TEST(Model, ValidateWantsTexturePointsForATexture) {
  Model model = one_triangle();
  model.materials[0].texture = Image(2, 2, 3, 0.5F);
  EXPECT_TRUE(mentions(model.validate(), "no texture points"));
  model.meshes[0].uv.setZero(3, 2);
  EXPECT_EQ(model.validate(), "");
}

TEST(Material, EachPresetIsUsable) {
  EXPECT_EQ(material_preset_names().size(), 8U);
  for (const std::string& name : material_preset_names()) {
    const Material material = material_preset(name);
    EXPECT_EQ(material.name, name);
    EXPECT_EQ(material.validate(), "") << name;
  }
}

TEST(Material, PresetsAreWhatTheirNamesSay) {
  EXPECT_EQ(material_preset("diffuse").kind, MaterialKind::kDiffuse);
  EXPECT_EQ(material_preset("plastic").kind, MaterialKind::kPlastic);
  EXPECT_FLOAT_EQ(material_preset("plastic").ior, 1.362F);
  EXPECT_LT(material_preset("plastic").roughness, kSmooth);
  EXPECT_EQ(material_preset("silver").kind, MaterialKind::kMetal);
  EXPECT_GT(material_preset("silver").roughness, kSmooth);
  EXPECT_EQ(material_preset("mirror").kind, MaterialKind::kMetal);
  EXPECT_LT(material_preset("mirror").roughness, kSmooth);
  EXPECT_EQ(material_preset("mirror").colour, Eigen::Vector3f::Ones());
  EXPECT_EQ(material_preset("glass").kind, MaterialKind::kGlass);
}

TEST(Material, UnknownPresetIsRefused) {
  expect_error(ExitCode::kUsage, {"'unobtainium'", "silver"}, [] { material_preset("unobtainium"); });
  expect_error(ExitCode::kUsage, {"''"}, [] { material_preset(""); });
}

TEST(Material, ColourIsFrom0To1) {
  Material material;
  for (int channel = 0; channel < 3; ++channel) {
    for (const float good : {0.0F, 1.0F}) {
      material.colour[channel] = good;
      EXPECT_EQ(material.validate(), "");
    }
    for (const float wrong : {-0.01F, 1.01F, kNan, kInfinity}) {
      material.colour[channel] = wrong;
      EXPECT_TRUE(mentions(material.validate(), "colour")) << wrong;
    }
    material.colour[channel] = 0.5F;
  }
}

TEST(Material, RoughnessIsFrom0To1) {
  for (const float good : {0.0F, 1.0F}) EXPECT_EQ(Material{.roughness = good}.validate(), "");
  for (const float wrong : {-0.01F, 1.01F, kNan, kInfinity}) {
    EXPECT_TRUE(mentions(Material{.roughness = wrong}.validate(), "roughness")) << wrong;
  }
}

TEST(Material, IndexIsFrom1To3) {
  for (const float good : {1.0F, 3.0F}) EXPECT_EQ(Material{.ior = good}.validate(), "");
  for (const float wrong : {0.99F, 3.01F, kNan, kInfinity}) {
    EXPECT_TRUE(mentions(Material{.ior = wrong}.validate(), "index")) << wrong;
  }
}

TEST(Material, TextureHasThreeChannels) {
  EXPECT_EQ(Material{.texture = Image(4, 2, 3)}.validate(), "");
  for (const int wrong : {1, 4}) {
    EXPECT_TRUE(mentions(Material{.texture = Image(4, 2, wrong)}.validate(), "texture"));
  }
}

}  // namespace
}  // namespace faceprobe::render
