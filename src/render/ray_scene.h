#pragma once
// A model and the ground under it, ready for rays (Embree).

#include "faceprobe/render/model.h"
#include "faceprobe/render/path_tracer.h"
#include "render/bsdf.h"

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace faceprobe::render {

struct SurfaceHit {
  float distance = std::numeric_limits<float>::infinity();
  bool ground = false;
  Eigen::Vector3f position;
  Eigen::Vector3f face;  // geometric normal, on the side the ray came from
  Bsdf bsdf{};
};

class RayScene {
 public:
  RayScene(Model model, const std::optional<Ground>& ground);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // The first surface along a ray; false when there is none. Thread-safe.
  bool hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, SurfaceHit& out) const;
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far, bool by_ground = true) const;
  // Where a ray that leaves a surface starts, so that it does not meet that again.
  static Eigen::Vector3f start(const Eigen::Vector3f& position, const Eigen::Vector3f& face,
                               const Eigen::Vector3f& direction);

 private:
  float ground_distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace faceprobe::render
