#pragma once
// The renderer under test, as the generator of synthetic faces uses it.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/map_light.h"
#include "faceprobe/synth/scene.h"
#include "faceprobe/synth/transport.h"

#include <chrono>
#include <span>
#include <vector>

namespace faceprobe::bench {

struct FastPicture {
  Image diffuse;  // 3 channels: radiance of a white Lambertian surface under direct light
  Image glossy;   // 3 channels: radiance of the lobe with rho_s = 1
};

// A map and how it is turned about the camera's +y before it lights the face.
struct TurnedMap {
  const synth::MapLight* map = nullptr;
  float yaw = 0;  // radians
};

class FastView {
 public:
  // One lobe everywhere; `mesh` is in the scene's frame.
  FastView(const synth::SurfaceMesh& mesh, const synth::PinholeCamera& camera, float roughness, float f0,
           const synth::TransportOptions& options);

  std::vector<FastPicture> render(std::span<const TurnedMap> maps) const;

  // 1 where all of the pixel is skin whose vertices are all below `vertices`.
  ByteImage fully_covered(int vertices) const;
  // Seconds the constructor took: structure for rays, fragments, both transports.
  double seconds() const { return seconds_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();  // before the rest is made
  synth::PinholeCamera camera_;
  synth::TransportOptions options_;
  synth::Scene scene_;
  synth::SceneTransport transport_;
  synth::ViewTransport view_;
  double seconds_ = 0;
};

}  // namespace faceprobe::bench
