#include "insert_cycles/scene.h"

#include "faceprobe/assets/model.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/render/shapes.h"

#include <cmath>

namespace faceprobe::bench {

namespace {

using render::Material;
using render::MaterialKind;

constexpr float kHeight = 0.25F;  // metres, of the thing
constexpr float kCard = 0.35F;    // half its edge
constexpr float kGap = 5e-4F;     // between thing and card, so that no triangles coincide
constexpr double kTiltDeg = 20;   // how far the camera seems to look down: the world is tilted, not the camera
constexpr double kFocal = 2.4;    // widths of the picture
const Eigen::Vector3f kFoot(0, -0.12F, -1);

render::TriangleMesh card() {
  render::TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << -kCard, 0, kCard, kCard, 0, kCard, kCard, 0, -kCard, -kCard, 0, -kCard;
  mesh.normals = Eigen::RowVector3f::UnitY().replicate(4, 1);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.material = 1;
  return mesh;
}

}  // namespace

const std::vector<TestMaterial>& test_materials() {
  static const Eigen::Vector3f kWhite = Eigen::Vector3f::Ones();
  static const std::vector<TestMaterial> kAll = {
      {"diffuse", {.kind = MaterialKind::kDiffuse, .colour = 0.8F * kWhite}},
      // White, so that Schlick's term is 1: Cycles' metal has none.
      {"metal", {.kind = MaterialKind::kMetal, .colour = kWhite, .roughness = 0.45F}},
      {"mirror", {.kind = MaterialKind::kMetal, .colour = kWhite}},
      {"plastic", {.kind = MaterialKind::kPlastic, .colour = 0.9F * kWhite, .ior = 1.362F}},
      {"glass", {.kind = MaterialKind::kGlass, .colour = kWhite, .ior = 1.5F}}};
  return kAll;
}

render::Model stand_on_card(const std::filesystem::path& object, const Material& material) {
  render::Model model = object.empty() ? render::shape("pot") : assets::load_model(object).model;
  for (render::TriangleMesh& mesh : model.meshes) mesh.material = 0;
  const auto tilt = static_cast<float>(radians(kTiltDeg));
  const Eigen::Vector3f up(0, std::cos(tilt), std::sin(tilt));
  render::place(model, {.height_m = kHeight, .foot_m = kFoot, .up = up});
  render::Model ground{{card()}, {}};
  render::transform(ground, Eigen::Translation3f(kFoot - kGap * up) *
                                Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitY(), up));
  model.meshes.push_back(std::move(ground.meshes.front()));
  model.materials = {material, {.kind = MaterialKind::kDiffuse, .colour = Eigen::Vector3f::Constant(0.4F)}};
  return model;
}

render::PinholeView scene_view(int size_px) {
  return {kFocal * size_px, 0.5 * size_px, 0.5 * size_px, size_px, size_px};
}

}  // namespace faceprobe::bench
