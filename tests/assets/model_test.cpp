#include "faceprobe/assets/model.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/picture_file.h"
#include "model_fixtures.h"

#include <cmath>
#include <fstream>

namespace faceprobe::assets {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): every helper is this file's business
using render::MaterialKind;

// Red above, blue below.
void write_flag(const std::filesystem::path& path) {
  ByteImage picture(2, 2, 3);
  for (int x = 0; x < 2; ++x) picture(x, 0, 0) = picture(x, 1, 2) = 255;
  io::write_picture(path, picture);
}

// The triangles' normal in space, from their corners' order.
Eigen::Vector3f normal_of(const render::TriangleMesh& mesh, int triangle) {
  const Eigen::RowVector3i t = mesh.triangles.row(triangle);
  const Eigen::Vector3f a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
  return (b - a).cross(c - a).normalized();
}

Eigen::RowVector2f uv_at(const render::TriangleMesh& mesh, const Eigen::RowVector3f& place) {
  Eigen::Index row = 0;
  EXPECT_LE((mesh.vertices.rowwise() - place).rowwise().norm().minCoeff(&row), 1e-6F);
  return mesh.uv.row(row);
}

TEST(LoadModel, ReadsAnObjWithItsMaterialAndTexture) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "maps");
  write_flag(folder / "maps/flag one.png");
  write_text(folder / "quad.mtl", "newmtl paint\nKd 0.5 0.25 1\nKs 0 0 0\nNs 10\nmap_Kd maps\\flag one.png\n");
  write_text(folder / "quad.OBJ", std::string("mtllib quad.mtl\n") + kQuad);
  const LoadedModel loaded = load_model(folder / "quad.OBJ");
  ASSERT_EQ(loaded.model.meshes.size(), 1U);
  const render::TriangleMesh& mesh = loaded.model.meshes[0];
  EXPECT_EQ(mesh.vertices.rows(), 4);
  ASSERT_EQ(mesh.triangles.rows(), 2);
  EXPECT_EQ(normal_of(mesh, 0), Eigen::Vector3f::UnitZ());
  EXPECT_EQ(normal_of(mesh, 1), Eigen::Vector3f::UnitZ());
  EXPECT_EQ(mesh.normals.row(0), Eigen::RowVector3f::UnitZ());
  EXPECT_EQ(uv_at(mesh, {-1, 2, 0}), Eigen::RowVector2f(0, 1));  // v is up
  EXPECT_EQ(uv_at(mesh, {1, 0, 0}), Eigen::RowVector2f(1, 0));
  const render::Material& material = loaded.model.materials.at(static_cast<std::size_t>(mesh.material));
  EXPECT_EQ(material.name, "paint");
  EXPECT_EQ(material.kind, MaterialKind::kDiffuse);
  EXPECT_EQ(material.colour, Eigen::Vector3f(0.5F, 0.25F, 1));
  ASSERT_EQ(material.texture.channels(), 3);
  EXPECT_NEAR(material.texture(0, 0, 0), 1, 1e-6F);
  EXPECT_NEAR(material.texture(0, 1, 2), 1, 1e-6F);
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings[0];
}

TEST(LoadModel, TellsMtlKindsApart) {
  const TempFolder folder;
  const auto material = [&](const std::string& mtl) {
    write_text(folder / "a.mtl", "newmtl paint\nKd 0.5 0.5 0.5\n" + mtl);
    write_text(folder / "a.obj", std::string("mtllib a.mtl\n") + kQuad);
    const render::Model model = load_model(folder / "a.obj").model;
    return model.materials.at(static_cast<std::size_t>(model.meshes.at(0).material));
  };
  EXPECT_EQ(material("Ns 50\n").kind, MaterialKind::kDiffuse);
  EXPECT_EQ(material("Ns 198\nillum 2\n").kind, MaterialKind::kPlastic);
  EXPECT_NEAR(material("Ns 198\nillum 2\n").roughness, std::sqrt(0.1F), 1e-5F);  // (2 / 200)^(1/4)
  EXPECT_EQ(material("Ns 198\nillum 1\n").kind, MaterialKind::kDiffuse);
  EXPECT_EQ(material("Ns 30\nKs 0.9 0.9 0.9\nillum 2\n").kind, MaterialKind::kPlastic);
  const render::Material glass = material("d 0.1\nNi 1.33\n");
  EXPECT_EQ(glass.kind, MaterialKind::kGlass);
  EXPECT_NEAR(glass.ior, 1.33F, 1e-6F);
}

TEST(LoadModel, DrawsAnObjWithoutItsMaterialFile) {
  const TempFolder folder;
  write_text(folder / "a.obj", std::string("mtllib lost.mtl\n") + kQuad);
  const LoadedModel loaded = load_model(folder / "a.obj");
  ASSERT_FALSE(loaded.warnings.empty());
  EXPECT_NE(loaded.warnings[0].find("lost.mtl"), std::string::npos);
  EXPECT_EQ(loaded.model.triangle_count(), 2);
}

void expect_cube(const render::Model& model) {
  ASSERT_EQ(model.meshes.size(), 1U);
  const render::TriangleMesh& mesh = model.meshes[0];
  ASSERT_EQ(mesh.triangles.rows(), 12);
  EXPECT_EQ(model.box().min(), Eigen::Vector3f(-1, -1, -1));
  EXPECT_EQ(model.box().max(), Eigen::Vector3f(1, 1, 1));
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3f corner = mesh.vertices.row(mesh.triangles(i, 0));
    EXPECT_GT(normal_of(mesh, i).dot(corner), 0.9F) << i;                                  // outwards
    EXPECT_GT(mesh.normals.row(mesh.triangles(i, 0)).dot(normal_of(mesh, i)), 0.3F) << i;  // and so are the vertices'
  }
}

TEST(LoadModel, ReadsPly) {
  const TempFolder folder;
  write_text(folder / "cube.ply", cube_ply());
  const LoadedModel plain = load_model(folder / "cube.ply");
  expect_cube(plain.model);
  EXPECT_EQ(plain.model.meshes[0].vertices.rows(), 8);
  EXPECT_EQ(plain.model.materials.at(0).kind, MaterialKind::kDiffuse);
  EXPECT_EQ(plain.model.materials[0].colour, render::Material{}.colour);
  EXPECT_TRUE(plain.warnings.empty());

  write_text(folder / "scan.ply", cube_ply("6", true));
  const LoadedModel scan = load_model(folder / "scan.ply");
  ASSERT_EQ(scan.warnings.size(), 1U);
  EXPECT_NE(scan.warnings[0].find("mean"), std::string::npos);
  // 8-bit sRGB, through assimp's division by 255.
  EXPECT_LE((scan.model.materials.at(0).colour - Eigen::Vector3f(1, linear_from_srgb(188 / 255.0F), 0)).norm(), 1e-5F);
}

// assimp takes a line feed at the start of a binary body for the end of the header's line.
TEST(LoadModel, ReadsABinaryPlyThatBeginsWithALineFeed) {
  const TempFolder folder;
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  float numbers[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t bits = 0x3F80000AU;  // 1.0000012, whose first byte is a line feed
  std::memcpy(numbers, &bits, sizeof bits);
  const std::int32_t indices[3] = {0, 1, 2};
  text.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  text += '\3';
  text.append(reinterpret_cast<const char*>(indices), sizeof indices);
  write_text(folder / "a.ply", text);
  const render::Model model = load_model(folder / "a.ply").model;
  EXPECT_EQ(model.triangle_count(), 1);
  EXPECT_EQ(model.box().max(), Eigen::Vector3f(numbers[0], 1, 0));
}

TEST(LoadModel, ReadsStlOfBothKinds) {
  const TempFolder folder;
  write_text(folder / "a.stl",
             "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 3 "
             "0\nendloop\nendfacet\nendsolid a\n");
  std::string binary(84, ' ');
  const std::uint32_t count = 1;
  const float numbers[12] = {0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0};
  std::memcpy(binary.data() + 80, &count, sizeof count);
  binary.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
  write_text(folder / "b.stl", binary);
  for (const char* name : {"a.stl", "b.stl"}) {
    const render::Model model = load_model(folder / name).model;
    ASSERT_EQ(model.triangle_count(), 1) << name;
    EXPECT_EQ(model.box().max(), Eigen::Vector3f(2, 3, 0));
    EXPECT_EQ(normal_of(model.meshes[0], 0), Eigen::Vector3f::UnitZ());
  }
}

TEST(LoadModel, ReadsGltfWithItsNodeTransforms) {
  const TempFolder folder;
  nlohmann::json document = triangle_gltf();
  document["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1}}}, {{"mesh", 0}, {"scale", {2, 2, 2}}}};
  document["nodes"][0]["skin"] = 7;  // what is not drawn is left out unread
  document["animations"] = {{{"channels", "none"}}};
  write_text(folder / "a.gltf", gltf_text(document));
  write_text(folder / "a.glb", glb_text(document));
  for (const char* name : {"a.gltf", "a.glb"}) {
    const LoadedModel loaded = load_model(folder / name);
    ASSERT_EQ(loaded.model.meshes.size(), 1U) << name;
    const render::TriangleMesh& mesh = loaded.model.meshes[0];
    EXPECT_EQ(loaded.model.box().min(), Eigen::Vector3f(10, 0, 0));
    EXPECT_EQ(loaded.model.box().max(), Eigen::Vector3f(12, 2, 0));
    EXPECT_EQ(normal_of(mesh, 0), Eigen::Vector3f::UnitZ());
    EXPECT_EQ(uv_at(mesh, {10, 0, 0}), Eigen::RowVector2f(0, 0));  // glTF's v is down, ours up
    EXPECT_EQ(uv_at(mesh, {10, 2, 0}), Eigen::RowVector2f(0, 1));
    const render::Material& gold = loaded.model.materials.at(static_cast<std::size_t>(mesh.material));
    EXPECT_EQ(gold.name, "gold");
    EXPECT_EQ(gold.kind, MaterialKind::kMetal);
    EXPECT_EQ(gold.colour, Eigen::Vector3f(1, 0.75F, 0.25F));
    EXPECT_EQ(gold.roughness, 0.25F);
    EXPECT_TRUE(loaded.warnings.empty());
  }
  document["nodes"][1]["scale"] = {-1, 1, 1};  // a mirror turns triangles over; they must still face outwards
  write_text(folder / "b.gltf", gltf_text(document));
  const render::TriangleMesh mirrored = load_model(folder / "b.gltf").model.meshes.at(0);
  EXPECT_EQ(normal_of(mirrored, 0), Eigen::Vector3f::UnitZ());
  EXPECT_EQ(mirrored.normals.row(0), Eigen::RowVector3f::UnitZ());
}

TEST(LoadModel, TellsGltfKindsApartAndReadsEmbeddedTextures) {
  const TempFolder folder;
  nlohmann::json document = triangle_gltf();
  const auto material = [&] {
    write_text(folder / "a.glb", glb_text(document));
    const render::Model model = load_model(folder / "a.glb").model;
    return model.materials.at(static_cast<std::size_t>(model.meshes.at(0).material));
  };
  nlohmann::json& surface = document["materials"][0]["pbrMetallicRoughness"];
  surface["metallicFactor"] = 0.2;
  EXPECT_EQ(material().kind, MaterialKind::kPlastic);
  surface["roughnessFactor"] = 0.7;
  EXPECT_EQ(material().kind, MaterialKind::kDiffuse);
  document["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.9;
  EXPECT_EQ(material().kind, MaterialKind::kGlass);

  write_flag(folder / "flag.png");
  std::ifstream stream(folder / "flag.png", std::ios::binary);
  const std::string png((std::istreambuf_iterator<char>(stream)), {});
  document = triangle_gltf();
  document["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}},
                                                      {"metallicRoughnessTexture", {{"index", 0}}}};
  document["textures"] = {{{"source", 0}}};
  document["images"] = {{{"uri", "data:image/png;base64," + base64(png)}}};
  const render::Material embedded = material();
  ASSERT_EQ(embedded.texture.height(), 2);
  EXPECT_NEAR(embedded.texture(0, 0, 0), 1, 1e-6F);
  EXPECT_EQ(embedded.roughness, 0);  // the map's green: none
  EXPECT_LE((embedded.colour - Eigen::Vector3f::Ones()).norm(), 0);
  ByteImage map(1, 1, 3);
  map(0, 0, 1) = 128, map(0, 0, 2) = 255;
  io::write_picture(folder / "map.png", map);
  document["textures"].push_back({{"source", 1}});
  document["images"] = {{{"uri", "flag.png"}}, {{"uri", "map.png"}}};
  document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] = 1;
  EXPECT_EQ(material().kind, MaterialKind::kMetal);
  EXPECT_NEAR(material().roughness, 128 / 255.0F, 1e-5F);
  EXPECT_EQ(material().texture, embedded.texture);
  document["meshes"][0]["primitives"][0].erase("material");
  EXPECT_EQ(material().kind, MaterialKind::kDiffuse);  // not glTF's default, a rough metal
}

}  // namespace
}  // namespace faceprobe::assets
