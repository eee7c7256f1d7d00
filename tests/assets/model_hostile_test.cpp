#include "faceprobe/assets/model.h"
#include "faceprobe/core/image.h"
#include "faceprobe/io/picture_file.h"
#include "model_fixtures.h"

#include <chrono>

namespace faceprobe::assets {
namespace {

using namespace testing;  // NOLINT(google-build-using-namespace): every helper is this file's business

class HostileModel : public ::testing::Test {
 protected:
  void refused(const std::string& name, const std::string& text, const std::vector<std::string>& parts,
               const ModelLimits& limits = {}) const {
    write_text(folder / name, text);
    expect_error(ExitCode::kInput, parts, [&] { load_model(folder / name, limits); });
  }
  void refused_gltf(const nlohmann::json& document, const std::vector<std::string>& parts,
                    const ModelLimits& limits = {}) const {
    refused("a.gltf", gltf_text(document), parts, limits);
    refused("a.glb", glb_text(document), parts, limits);
  }
  TempFolder folder;
};

TEST_F(HostileModel, RefusesWhatIsNoModelFile) {
  expect_error(ExitCode::kInput, {"lost.obj", "is not there"}, [&] { load_model(folder / "lost.obj"); });
  std::filesystem::create_directory(folder / "room.ply");
  expect_error(ExitCode::kInput, {"room.ply", "is a folder"}, [&] { load_model(folder / "room.ply"); });
  for (const char* name : {"a.obj", "a.ply", "a.gltf", "a.glb", "a.stl"}) refused(name, "", {name, "is empty"});
  refused("a.fbx", "Kaydara", {"a.fbx", "unknown extension", ".glb"});
  for (const char* name : {"a.obj", "a.ply", "a.gltf", "a.glb", "a.stl"}) {
    refused(name, std::string("\x93\x01garbage \xFF\x00 more of it\n 12 \x7F", 29), {name});
  }
  refused("a.obj", kQuad, {"bytes", "at most 10"}, {.max_file_bytes = 10});
  refused("a.obj", kQuad, {"triangles", "at most 1"}, {.max_triangles = 1});
  refused("a.obj", kQuad, {"vertices", "at most 3"}, {.max_vertices = 3});
  expect_error(ExitCode::kUsage, {"triangles", "at least 1"},
               [&] { load_model(folder / "a.obj", {.max_triangles = 0}); });
}

TEST_F(HostileModel, RefusesWhatIsCutShort) {
  const std::string glb = glb_text(triangle_gltf());
  for (std::size_t size = 1; size < glb.size(); size += 7) refused("a.glb", glb.substr(0, size), {"a.glb"});
  refused("a.glb", glb.substr(0, glb.size() - 8), {"cut short"});
  const std::string ply = cube_ply();
  for (std::size_t size = 1; size + 10 < ply.size(); size += 7) refused("a.ply", ply.substr(0, size), {"a.ply"});
  refused("a.stl", std::string(83, 'x') + "1234", {"cut short"});
}

TEST_F(HostileModel, RefusesClaimsAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  refused("a.ply", cube_ply("50000000"), {"50000000", "triangles", "5000000"});
  refused("a.ply", cube_ply("4000000"), {"cut short"});
  nlohmann::json document = triangle_gltf();
  document["accessors"][0]["count"] = 4'000'000'000;
  refused_gltf(document, {"4000000000", "bufferView"});
  document = triangle_gltf();
  document["buffers"][0]["byteLength"] = 4'000'000;
  refused_gltf(document, {"4000000 bytes", "cut short"});
  EXPECT_LT(std::chrono::steady_clock::now() - start,
            std::chrono::seconds(5));  // milliseconds, on a machine that is not busy
}

TEST_F(HostileModel, RefusesBadNumbers) {
  refused("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", {"a.obj", "1 of 3", "finite"});
  refused("a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 inf 0\nf 1 2 3\n", {"2 of 3", "finite"});
  refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", {"a.obj"});
  refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", {"a.obj"});
  refused("a.ply", cube_ply().replace(cube_ply().find("4 0 2 3 1"), 9, "4 0 2 3 8"), {"vertex 8", "there are 8"});
  refused("a.ply", cube_ply().replace(cube_ply().find("4 0 2 3 1"), 9, "4 0 2 3 -1"), {"vertex -1"});
  refused("a.ply", cube_ply("1").replace(cube_ply("1").find("4 0 2 3 1"), 9, "0"), {"face without corners"});
  nlohmann::json document = triangle_gltf();
  document["nodes"][0]["scale"] = {1e38, 1e38, 1};
  refused_gltf(document, {"finite"});
}

TEST_F(HostileModel, RefusesWhatHasNoSurface) {
  refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"a.obj", "triangles"});
  refused("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\nl 1 2\n", {"a.obj", "triangles"});
  const std::string ply = cube_ply("0");
  refused("a.ply", ply.substr(0, ply.find("4 0 2 3 1")), {"a.ply", "triangles"});
  nlohmann::json document = triangle_gltf();
  document["meshes"][0]["primitives"][0]["mode"] = 0;
  refused_gltf(document, {"triangles"});
}

TEST_F(HostileModel, RefusesTexturesThatAreNotBesideTheModel) {
  const TempFolder other;
  io::write_picture(other / "outside.png", ByteImage(2, 2, 3));
  std::filesystem::create_symlink(other / "outside.png", folder / "link.png");
  write_text(folder / "broken.png", "no picture");
  const auto texture = [&](const std::string& name, const std::vector<std::string>& parts) {
    write_text(folder / "a.mtl", "newmtl paint\nmap_Kd " + name + "\n");
    refused("a.obj", std::string("mtllib a.mtl\n") + kQuad, parts);
    nlohmann::json document = triangle_gltf();
    document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    document["textures"] = {{{"source", 0}}};
    document["images"] = {{{"uri", name}}};
    refused_gltf(document, parts);
  };
  texture("lost.png", {"names the texture 'lost.png'", "not there", "beside the model"});
  texture("broken.png", {"names the texture 'broken.png'", "cannot be used"});
  texture("../" + other.path().filename().string() + "/outside.png", {"outside.png", "outside its folder"});
  texture((other / "outside.png").string(), {"outside.png", "outside its folder"});
  texture("link.png", {"link.png", "outside its folder"});
  texture("/etc/passwd", {"/etc/passwd", "outside its folder"});
}

TEST_F(HostileModel, RefusesCompanionsOutside) {
  const TempFolder other;
  write_text(other / "a.mtl", "newmtl paint\n");
  write_text(other / "a.bin", triangle_bytes());
  const std::string up = "../" + other.path().filename().string();
  refused("a.obj", "mtllib " + up + "/a.mtl\n" + kQuad, {"a.mtl", "outside its folder"});
  nlohmann::json document = triangle_gltf();
  for (const std::string& uri : {up + "/a.bin", (other / "a.bin").string(), std::string("/dev/zero")}) {
    document["buffers"][0]["uri"] = uri;
    refused("b.gltf", document.dump(), {uri, "outside its folder"});
  }
  document["buffers"][0]["uri"] = "lost.bin";
  refused("b.gltf", document.dump(), {"lost.bin", "not there"});
}

// assimp 5.2 crashes on statements before the first newmtl.
TEST_F(HostileModel, DrawsWithMaterialFilesThatAreWrong) {
  for (const char* mtl : {"Kd 1 0 0\nillum 2\nnewmtl paint\nKd 0 1 0\n", "Kd 1 0 0\n"}) {
    write_text(folder / "a.mtl", mtl);
    write_text(folder / "a.obj", std::string("mtllib a.mtl\n") + kQuad);
    EXPECT_EQ(load_model(folder / "a.obj").model.triangle_count(), 2);
  }
}

TEST_F(HostileModel, RefusesTreesThatAreNone) {
  nlohmann::json document = triangle_gltf();
  document["nodes"][0]["children"] = {0};
  refused_gltf(document, {"node"});
  document["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  refused_gltf(document, {"two parents"});
  document["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 1000; ++i) document["nodes"].push_back({{"mesh", 0}, {"children", {i + 1}}});
  document["nodes"].push_back({{"mesh", 0}});
  refused_gltf(document, {"200 deep"});
  document["scenes"][0]["nodes"] = nlohmann::json::array();
  document["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 5; ++i) {
    document["nodes"].push_back({{"mesh", 0}});
    document["scenes"][0]["nodes"].push_back(i);
  }
  refused_gltf(document, {"copies", "at most 4"}, {.max_triangles = 4});
  refused("a.gltf", std::string(100'000, '['), {"a.gltf", "nested"});
  document = triangle_gltf();
  document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  refused_gltf(document, {"KHR_draco_mesh_compression"});
}

}  // namespace
}  // namespace faceprobe::assets
