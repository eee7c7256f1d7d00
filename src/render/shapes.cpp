#include "faceprobe/render/shapes.h"

#include "faceprobe/core/error.h"
#include "loft.h"
#include "rounded_box.h"

#include <array>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr float kRadius = 0.5F;
constexpr int kSteps = 64;  // 2.8 degrees between normals, which are exact at the vertices

struct Entry {
  std::string_view name;
  Model (*make)();
};

constexpr std::array<Entry, 5> kShapes{
    {{"sphere", sphere}, {"cube", cube}, {"pot", pot}, {"robot", robot}, {"spheres", three_spheres}}};

void raise(TriangleMesh& mesh, const Eigen::RowVector3f& shift) { mesh.vertices.rowwise() += shift; }

}  // namespace

Model sphere() {
  Model model;
  model.materials = {material_preset("plastic")};
  model.meshes = {ball(kRadius, kSteps)};
  raise(model.meshes[0], {0, kRadius, 0});
  return model;
}

Model cube() {
  Model model;
  model.materials = {material_preset("clay")};
  model.meshes = {rounded_box(Eigen::Vector3f::Ones(), 0.04F)};
  raise(model.meshes[0], {0, 0.5F, 0});
  return model;
}

Model three_spheres() {
  constexpr float kStep = 1.1F;  // a tenth of a diameter between them
  Model model;
  model.materials = {material_preset("diffuse"), material_preset("silver"), material_preset("mirror")};
  for (int i = 0; i < 3; ++i) {
    TriangleMesh one = ball(kRadius, kSteps);
    raise(one, {kStep * static_cast<float>(i - 1), kRadius, 0});
    one.material = i;
    model.meshes.push_back(std::move(one));
  }
  return model;
}

Model shape(std::string_view name) {
  for (const Entry& entry : kShapes) {
    if (entry.name == name) return entry.make();
  }
  throw Error(ExitCode::kUsage,
              "There is no shape called '" + std::string(name) + "'; take one of " + listed(shape_names()) + ".");
}

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    list.reserve(kShapes.size());
    for (const Entry& entry : kShapes) list.emplace_back(entry.name);
    return list;
  }();
  return names;
}

}  // namespace faceprobe::render
