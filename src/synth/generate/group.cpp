#include "synth/generate/group.h"

#include "faceprobe/core/angles.h"
#include "synth/generate/turn.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

enum GroupPurpose : std::uint64_t { kPlaces = 21, kGroupCamera };

constexpr double kShoulders =
    0.52;  // metres between the middles of neighbours at least: they do not cut through each other
constexpr float kFaceRoom = 0.16F;      // metres around an origin between the eyes that belong to the face
constexpr float kMostTilt = 0.17F;      // radians, of the camera upwards
constexpr float kWaistY = -0.55F;       // below the eyes, where bodies are about to end
constexpr float kHeadMiddleY = -0.04F;  // from between the eyes down to the middle of the face

Random scene_random(const Recipe& recipe, int number) {
  return Random({recipe.seed, static_cast<std::uint64_t>(recipe.split), static_cast<std::uint64_t>(number), 0x6209});
}

void place(const Eigen::Isometry3f& pose, Figure& figure) {
  const Eigen::Matrix3f rotation = pose.linear();
  const Eigen::RowVector3f shift = pose.translation().transpose();
  for (SurfaceMesh& mesh : figure.meshes) {
    mesh.vertices = (mesh.vertices * rotation.transpose()).rowwise() + shift;
    mesh.normals = mesh.normals * rotation.transpose();
  }
  for (Strands& strands : figure.strands) {
    strands.points.leftCols<3>() = (strands.points.leftCols<3>() * rotation.transpose()).eval().rowwise() + shift;
  }
}

Eigen::Vector3f face_middle(const Person& person) {
  return person.scene_from_head * Eigen::Vector3f(0, kHeadMiddleY, 0);
}

}  // namespace

std::vector<Person> draw_people(const Assets& assets, const Recipe& recipe, int number) {
  std::vector<Person> people;
  if (!recipe.multi_face) {
    people.push_back(draw_person(assets, recipe, number));
    return people;
  }
  Random random = scene_random(recipe, number).split(kPlaces);
  const int drawn = 2 + random.below(kMostPeople - 1);
  const int count = recipe.people.value_or(drawn);
  const double distance_m = random.between(1.3, 2.8);
  std::vector<double> along(static_cast<std::size_t>(count), 0.0);
  for (std::size_t i = 1; i < along.size(); ++i) along[i] = along[i - 1] + random.between(kShoulders, 0.95);
  const double middle = along.back() / 2;
  int figures = 0;
  for (int i = 0; i < count; ++i) {
    Person person = draw_person(assets, recipe, number * kMostPeople + i);
    const double depth_m = distance_m + random.between(-0.35, 0.35);
    person.scene_from_head.linear() =
        turn(random.normal(0, radians(14)), random.normal(0, radians(6)), random.normal(0, radians(4)));
    person.scene_from_head.translation() =
        Eigen::Vector3d(along[static_cast<std::size_t>(i)] - middle, random.normal(0, 0.08), -depth_m).cast<float>();
    person.first_figure = figures;
    for (Figure& figure : person.figures) place(person.scene_from_head, figure);
    figures += static_cast<int>(person.figures.size());
    people.push_back(std::move(person));
  }
  return people;
}

View draw_scene_view(std::span<const Person> people, const Recipe& recipe, int number, int view) {
  if (!recipe.multi_face) return draw_view(people.front(), recipe, view);
  Random random = scene_random(recipe, number).split(kGroupCamera).split(static_cast<std::uint64_t>(view));
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const Person& person : people) middle += face_middle(person) / static_cast<float>(people.size());

  // The camera walks around the group and aims at it.
  View result;
  const Eigen::Vector3f stand =
      middle + turn(random.normal(0, radians(9)), random.normal(0, radians(4)), 0) *
                   Eigen::Vector3f(0, 0, -middle.z() * static_cast<float>(random.between(0.9, 1.1)));
  const Eigen::Vector3f back = (stand - middle).normalized();
  Eigen::Matrix3f scene_from_camera;
  scene_from_camera.col(0) = Eigen::Vector3f::UnitY().cross(back).normalized();
  scene_from_camera.col(1) = back.cross(scene_from_camera.col(0));
  scene_from_camera.col(2) = back;
  const Eigen::Matrix3f roll = turn(0, 0, random.normal(0, radians(3)));
  result.camera.camera_from_scene.linear() = roll * scene_from_camera.transpose();
  result.camera.camera_from_scene.translation() = -(result.camera.camera_from_scene.linear() * stand);
  result.camera.width_px = result.camera.height_px = recipe.size_px;
  result.camera.centre_px.setConstant(0.5F * static_cast<float>(recipe.size_px));

  // As long a lens as keeps every face inside, with some air, and tilted up until nobody's cut-off body is seen below, as far
  // as that goes.
  const auto air = static_cast<float>(random.between(1.05, 1.25));
  const Eigen::Vector3f from_camera = result.camera.camera_from_scene.translation();
  const Eigen::Matrix3f level = result.camera.camera_from_scene.linear();
  float tilt = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const Eigen::Matrix3f turn_up = turn(0, -static_cast<double>(tilt), 0);
    result.camera.camera_from_scene.linear() = turn_up * level;
    result.camera.camera_from_scene.translation() = turn_up * from_camera;
    float widest = 0;
    float highest_waist = -1e9F;  // as a slope below the axis
    for (const Person& person : people) {
      const Eigen::Vector3f at = result.camera.camera_from_scene * face_middle(person);
      const Eigen::Vector3f waist =
          result.camera.camera_from_scene * (person.scene_from_head * Eigen::Vector3f(0, kWaistY, 0));
      widest = std::max(widest, (std::max(std::abs(at.x()), std::abs(at.y())) + kFaceRoom) / -at.z());
      highest_waist = std::max(highest_waist, waist.y() / -waist.z());
    }
    const float half = widest * air;
    result.camera.focal_px = 0.5F * static_cast<float>(recipe.size_px) / half;
    // More tilt asks for a wider view, and that for more tilt: people near the camera would end small at the edge.
    if (pass < 2) tilt = std::min(kMostTilt, tilt + std::max(0.0F, std::atan(half) + std::atan(highest_waist)));
  }
  result.camera_from_level = result.camera.camera_from_scene.linear();
  return result;
}

}  // namespace faceprobe::synth
