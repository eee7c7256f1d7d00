#pragma once
// One path of light from the camera, and what it brings.

#include "faceprobe/render/path_tracer.h"
#include "render/light_set.h"
#include "render/ray_scene.h"
#include "render/sobol.h"

#include <Eigen/Core>

namespace faceprobe::render {

struct PathScene {
  const RayScene& rays;
  const LightSet& lights;
  const SceneOptions& options;
  int max_bounces = 12;
  float clamp_indirect = 0;
};

// What one sample of a pixel saw first, and the light of it.
struct PathSample {
  enum class First { kNothing, kModel, kGround } first = First::kNothing;
  Eigen::Vector3f light = Eigen::Vector3f::Zero();  // of the model; of the ground with the model there, over its albedo
  Eigen::Vector3f open = Eigen::Vector3f::Zero();   // of the ground if the model were not there
  float depth = 0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

// `direction`: of unit length, from the camera.
PathSample trace_path(const PathScene& scene, const Eigen::Vector3f& direction, SobolSampler& random);

}  // namespace faceprobe::render
