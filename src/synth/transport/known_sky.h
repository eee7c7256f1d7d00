#pragma once
// Internal: what the rows' visibility of the sky already says about a small distant light, so that most points need no ray. Where all
// cells within a cell's width of the light are wholly free, or wholly blocked, the light is taken to be so too; only what is
// thinner than a cell (3.7 degrees at nside 16) and stands alone before an open sky is missed by that. Coarser cells are not believed.

#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/synth/transport.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace faceprobe::synth {

// What is known of a light at a vertex; bits.
enum LightSeen : std::uint8_t { kDark = 0, kLit = 1, kCertain = 2 };

class KnownSky {
 public:
  // `grid`: the transport's cells. Keeps a reference to the transport.
  KnownSky(const SceneTransport& transport, const SphereGrid& grid, const Eigen::Vector3f& direction);

  // kCertain | kLit, kCertain | kDark, or 0 when a ray has to tell.
  std::uint8_t at(int row) const {
    if (cells_.empty()) return 0;
    const std::uint8_t* share = transport_.visibility.data() +
                                static_cast<std::size_t>(row) * static_cast<std::size_t>(transport_.diffuse.cols());
    const std::uint8_t first = share[cells_.front()];
    if (first != 0 && first != 255) return 0;
    for (const int cell : cells_) {
      if (share[cell] != first) return 0;
    }
    return first == 255 ? kCertain | kLit : kCertain | kDark;
  }

 private:
  const SceneTransport& transport_;
  std::vector<int> cells_;  // around the light; empty when the cells are too coarse
};

}  // namespace faceprobe::synth
