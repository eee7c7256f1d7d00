#include "pipeline/insertion_light.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/pipeline/room.h"
#include "pipeline/dimmed_lights.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace faceprobe::pipeline {
namespace {

constexpr float kLampRadiusM = 0.04F;  // a bulb with its shade: triangulation does not tell

std::size_t nearest_face(const Estimate& estimate, const Eigen::Vector3f& foot) {
  const auto distance = [&](const FaceEstimate& face) { return (face.face.position_m().cast<float>() - foot).norm(); };
  const auto nearest = std::min_element(estimate.faces.begin(), estimate.faces.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  return static_cast<std::size_t>(nearest - estimate.faces.begin());
}

// Of each main light of a map the lamp that it is, or none.
using LampOfLight = std::vector<const lighting::Lamp*>;

LampOfLight lamps_of_face(const Room& room, std::size_t index) {
  LampOfLight of_light(room.faces[index].lights.size(), nullptr);
  for (const lighting::Lamp& lamp : room.lamps) {
    for (const lighting::Sighting& seen : lamp.seen) {
      if (lamp.near && seen.face == static_cast<int>(index)) of_light[static_cast<std::size_t>(seen.light)] = &lamp;
    }
  }
  return of_light;
}

const Eigen::Vector3d& place_of(const Room& room, const lighting::Sighting& seen) {
  return room.faces[static_cast<std::size_t>(seen.face)].position_m;
}

// The joint map has a lamp about where the faces see it, once or as several lights: each of its lights is the lamp that a face sees nearest to it.
LampOfLight lamps_of_joint(const Room& room, const std::vector<lighting::MainLight>& lights) {
  LampOfLight of_light;
  for (const lighting::MainLight& light : lights) {
    const lighting::Lamp* nearest = nullptr;
    double least_deg = lighting::TriangulateOptions{}.max_miss_deg;
    const auto consider = [&](const lighting::Lamp& lamp, const Eigen::Vector3d& direction) {
      const double miss = angle_between_deg(light.direction, direction);
      if (miss >= least_deg) return;
      least_deg = miss;
      nearest = &lamp;
    };
    for (const lighting::Lamp& lamp : room.lamps) {
      consider(lamp, lamp.direction);  // distant ones too, whose lights are theirs
      for (const lighting::Sighting& seen : lamp.seen) {
        if (lamp.near) consider(lamp, (lamp.position_m - place_of(room, seen)).normalized());
      }
    }
    of_light.push_back(nearest != nullptr && nearest->near ? nearest : nullptr);
  }
  return of_light;
}

// Squared distance at which a lamp gives what it gives these faces on average.
double squared_distance(const Room& room, const lighting::Lamp& lamp) {
  double sum = 0;
  for (const lighting::Sighting& seen : lamp.seen) sum += 1 / (lamp.position_m - place_of(room, seen)).squaredNorm();
  return static_cast<double>(lamp.seen.size()) / sum;
}

// The map without the lights that are lamps. A lamp is as strong as this map has it, not as all faces see it on average: what is taken off the map
// comes back whole.
template <class SquaredDistance>
void part(const LightResult& light, const LampOfLight& of_light, const InsertionOptions& options,
          const SquaredDistance& squared_distance_to, insert::Scene& scene) {
  std::vector<double> shares;
  for (std::size_t k = 0; k < of_light.size(); ++k) {
    shares.push_back(of_light[k] != nullptr ? 1 : 0);
    if (of_light[k] == nullptr) continue;
    const lighting::MainLight& main = light.lights[k];
    const Eigen::Vector3f position = of_light[k]->position_m.cast<float>();
    const Eigen::Vector3f intensity =
        (main.irradiance * squared_distance_to(*of_light[k]) * main.colour).template cast<float>();
    const auto known = std::ranges::find_if(scene.lamps, [&](const auto& lamp) { return lamp.position_m == position; });
    if (known != scene.lamps.end()) {
      known->intensity += intensity;  // two lights of the joint map
    } else {
      scene.lamps.push_back({.position_m = position, .radius_m = kLampRadiusM, .intensity = intensity});
    }
  }
  if (scene.lamps.empty()) return;
  const SphereGrid grid = SphereGrid::of_cells(light.light.radiance.rows());
  const Eigen::MatrixX3f rest =
      dimmed_lights(light.light.radiance, grid, shares, options.main_lights, light.light.confidence);
  scene.environment = env_map_from_grid(rest, grid, light.environment.width(), light.environment.height());
}

}  // namespace

void light_scene(const Estimate& estimate, const Eigen::Vector3f& foot, const InsertionOptions& options,
                 insert::Scene& scene) {
  const bool joint = options.joint_light && estimate.joint;
  const std::size_t index = options.face ? static_cast<std::size_t>(*options.face) : nearest_face(estimate, foot);
  const LightResult& light = joint ? *estimate.joint : estimate.faces[index];
  scene.environment = light.environment;
  scene.lamps.clear();
  if (estimate.faces.size() < 2) return;
  const Room room = find_lamps(estimate);
  if (joint) {
    part(
        light, lamps_of_joint(room, light.lights), options,
        [&](const lighting::Lamp& lamp) { return squared_distance(room, lamp); }, scene);
  } else {
    part(
        light, lamps_of_face(room, index), options,
        [&](const lighting::Lamp& lamp) { return (lamp.position_m - room.faces[index].position_m).squaredNorm(); },
        scene);
  }
}

}  // namespace faceprobe::pipeline
