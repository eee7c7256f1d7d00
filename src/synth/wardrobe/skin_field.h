#pragma once
// Signed distance to the skin (and what lies on it) on a grid: what keeps hair and cloth out of the head. Exact to a millimetre or so
// within its band; farther away it only says inside or outside.

#include "faceprobe/synth/mesh.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::synth {

class SkinField {
 public:
  // Covers the box of the mesh with a margin.
  SkinField(const Eigen::Vector3f& low, const Eigen::Vector3f& high, float cell_m);
  // Adds a surface with outward normals; the nearest one counts.
  void add(const SurfaceMesh& mesh);
  // To be called once after the last add(): tells inside from outside beyond the band.
  void finish();

  // Positive outside, at most `band()` and at least minus that; the gradient (not normalised) when asked for.
  float distance(const Eigen::Vector3f& p, Eigen::Vector3f* gradient = nullptr) const;
  float band() const { return band_; }
  // Moves p out to at least `clearance`; true when it had to.
  bool push_out(Eigen::Vector3f& p, float clearance) const;

 private:
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y()) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(x);
  }
  void splat(const Eigen::Vector3f& p, const Eigen::Vector3f& n);

  Eigen::Vector3f low_;
  float cell_;
  float band_;
  Eigen::Vector3i size_;
  std::vector<float> squared_;  // to the nearest sample
  std::vector<float> value_;
};

}  // namespace faceprobe::synth
