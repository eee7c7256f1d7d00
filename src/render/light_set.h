#pragma once
// Every light of a scene as one: draws a direction to one of them, and says how often it would have.

#include "faceprobe/render/path_tracer.h"
#include "render/map_sampler.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::render {

class LightSet {
 public:
  // `centre`: where the scene is, which decides how often each lamp is asked.
  LightSet(const EnvMap& map, const std::vector<BallLamp>& lamps, const Eigen::Vector3f& centre);

  struct Seen {
    Eigen::Vector3f direction;
    Eigen::Vector3f radiance = Eigen::Vector3f::Zero();
    float density = 0;   // per steradian, of draw()
    float distance = 0;  // how far the way has to be free
  };
  Seen draw(const Eigen::Vector3f& from, float choice, const Eigen::Vector2f& random) const;
  // The map alone.
  Seen map_along(const Eigen::Vector3f& direction) const;
  // All lamps that a ray meets before `far`, and the distance of the nearest; density 0 when there are none.
  Seen lamp_along(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float far) const;
  bool has_lamps() const { return !lamps_.empty(); }

 private:
  Seen draw_lamp(std::size_t lamp, const Eigen::Vector3f& from, const Eigen::Vector2f& random) const;

  MapSampler map_;
  std::vector<BallLamp> lamps_;
  std::vector<float> chance_;  // of each lamp
  float map_chance_ = 1;
};

}  // namespace faceprobe::render
