#pragma once
// The part of the skin that hair grows on, bounded by a hairline: up the temples, over the forehead, down in front of the ears, around
// them and along the nape.

#include "faceprobe/core/random.h"
#include "synth/wardrobe/anatomy.h"

#include <array>
#include <vector>

namespace faceprobe::synth {

struct HairlineShape {
  float front_m = 0.062F;    // height over the brows, on an average head
  float recess_m = 0.004F;   // how far the temples go back
  float sideburn_m = 0.02F;  // below the ears' tops
  float nape_m = 0.0F;       // lower than usual
  float raggedness_m = 0.0025F;
};

class Scalp {
 public:
  Scalp(const Anatomy& anatomy, const HairlineShape& shape, std::uint64_t seed);

  // Distance behind the hairline, metres; negative on bare skin. Smooth; right to a few tenths near the line.
  float inside(const Eigen::Vector3f& p) const;
  // The same with a ragged line.
  float ragged_inside(const Eigen::Vector3f& p) const;

  struct Root {
    Eigen::Vector3f position;
    Eigen::Vector3f normal;
    float inside;  // metres behind the hairline
  };
  // Evenly over the area, thinning out within `feather_m` of the line.
  std::vector<Root> roots(int count, float feather_m, Random& random) const;
  // Skin under the hair, `offset_m` above it, from `margin_m` behind the line.
  SurfaceMesh cap(float margin_m, float offset_m) const;
  float area() const { return area_; }

 private:
  struct Knot {
    float azimuth, y;
  };
  const Anatomy& anatomy_;
  HairlineShape shape_;
  std::uint64_t seed_;
  std::array<Knot, 14> line_;
  std::vector<float> vertex_inside_;
  std::vector<int> triangles_;  // those that may carry roots
  std::vector<float> area_up_to_;
  float area_ = 0;
};

}  // namespace faceprobe::synth
