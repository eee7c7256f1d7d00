#pragma once
// Draws a model under an environment map and lamps, standing on a ground that is not drawn but takes shadows, and says apart what belongs to
// the thing and what to the ground: what a photo needs to take the thing in (Debevec 1998, "Rendering synthetic objects into real scenes").
//
// Everything is in the camera's frame (CONVENTIONS.md): the camera at the origin looks along -z.
//
//   const PathTracer tracer(model, environment, {.view = {900, 320, 240, 640, 480}, .ground = Ground{.point_m = {0, -0.2F, -0.8F}}});
//   const Layers layers = tracer.render({.samples = 64});
//
// Unidirectional path tracing with multiple importance sampling of map, lamps and surfaces (Veach 1997). Not for animation, subsurface
// scattering, or caustics of small lamps through glass, which come out as noise.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/render/model.h"

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::render {

// Pinhole with square pixels; rays of pixel (x, y) go through the points (x + [0,1), y + [0,1)).
struct PinholeView {
  double focal_px = 0;
  double centre_x_px = 0, centre_y_px = 0;  // the principal point, from the top left corner
  int width_px = 0, height_px = 0;

  // Where the ray through (x, y) px is at depth 1, camera frame: (.., .., -1), not of unit length.
  Eigen::Vector3f ray(double x_px, double y_px) const {
    return Eigen::Vector3d((x_px - centre_x_px) / focal_px, (centre_y_px - y_px) / focal_px, -1).cast<float>();
  }
};

// A diffuse disc that the thing stands on.
struct Ground {
  Eigen::Vector3f point_m = Eigen::Vector3f::Zero();  // its centre
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();      // its normal, unit
  float radius_m = 1;
  Eigen::Vector3f albedo = Eigen::Vector3f::Constant(0.3F);  // linear, 0..1
};

// A small near light: a ball that shines evenly and lets all other light through. Not seen itself by the camera.
struct BallLamp {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();  // its centre, camera frame
  float radius_m = 0.05F;
  Eigen::Vector3f intensity =
      Eigen::Vector3f::Ones();  // radiance x projected area: irradiance at distance r is intensity / r^2
};

// A photo taken by the same camera: what is behind the scene.
struct Backdrop {
  PinholeView view;
  Image picture;  // view.width_px x height_px x 3, linear
};

struct SceneOptions {
  PinholeView view;
  std::optional<Ground> ground{};
  std::vector<BallLamp> lamps{};
  // What rays that only mirrors and glass have turned see where it shows something, in place of the map.
  std::optional<Backdrop> backdrop{};

  std::string validate() const;
};

struct RenderOptions {
  int samples = 64;  // per pixel, at most
  int least_samples = 16;
  // Stop a small square of the picture when the root mean square of its pixels' standard errors, over a mid grey or what is brighter, is
  // below this; 0 = all samples everywhere.
  float noise = 0;
  int max_bounces = 12;
  float clamp_indirect = 0;  // largest value that a path beyond its first bounce may add; 0 = no limit, and no bias
  std::uint64_t seed = 1;    // of the noise
  int threads = 0;
  // Called now and then by one thread at a time, with the share done, 0..1, which grows; returning false stops, and what there is comes back.
  std::function<bool(float)> progress{};

  std::string validate() const;
};

// view.width_px x height_px each, linear.
struct Layers {
  Image object;  // 4 channels: radiance of the model, premultiplied, and its coverage
  Image shadow;  // 3 channels: light that reaches the ground with the model there, over that without; 1 where no ground is seen
  Image ground;   // 1 channel: coverage of the ground disc; where the model hides it, not covered
  Image depth;    // 1 channel: metres along -z of the model, mean over its share of the pixel; 0 off it
  Image normal;   // 3 channels: mean normal of the model, camera frame; 0 off it
  Image samples;  // 1 channel: how many were taken
};

class PathTracer {
 public:
  // Throws std::invalid_argument when model or options do not validate, or the map is empty or holds what is negative or not finite.
  PathTracer(Model model, const EnvMap& environment, SceneOptions options);
  ~PathTracer();
  PathTracer(PathTracer&&) noexcept;
  PathTracer& operator=(PathTracer&&) noexcept;
  PathTracer(const PathTracer&) = delete;
  PathTracer& operator=(const PathTracer&) = delete;

  // The same bits for any number of threads. Throws std::invalid_argument when the options do not validate.
  Layers render(const RenderOptions& options = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What a white diffuse surface sends out with nothing around it: irradiance / pi from the map and the lamps, without noise. `point`: metres;
// `normal`: unit. Red, green, blue, in the unit of the map. A lamp that the point lies in gives nothing, as in PathTracer.
Eigen::Vector3f open_light(const EnvMap& environment, const std::vector<BallLamp>& lamps, const Eigen::Vector3f& point,
                           const Eigen::Vector3f& normal);

}  // namespace faceprobe::render
