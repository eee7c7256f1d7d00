#pragma once
// What lies on top of a skin's own colour at a place of the face: redness, freckles, moles; stubble, brows, make-up. Where on the face is
// told by the head frame (metres, origin midway between the eyes) and by soft shares of regions, so that nothing has a hard edge.

#include "faceprobe/core/smooth_step.h"
#include "faceprobe/synth/skin.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

namespace faceprobe::synth {

// The place that albedo is asked for.
struct SkinPlace {
  Eigen::Vector3f position;
  float lips = 0, brows = 0, eyelids = 0, beard = 0;  // shares, 0 .. 1
  Region region = Region::kCheeks;
  float footprint_m = 0;
};

// Everything that is the same for all points of a skin.
class Marks {
 public:
  explicit Marks(const SkinSettings& settings);

  // What pigments add along the axes of tone.h, in log albedo.
  struct Pigment {
    float melanin = 0;
    float haemoglobin = 0;
  };
  Pigment pigment(const SkinPlace& place) const;

  // Hair and make-up over `albedo` (linear). `textured`: brows may be in it already.
  void paint(const SkinPlace& place, bool textured, Eigen::Vector3f& albedo) const;

 private:
  float beard_coverage(const SkinPlace& place) const;

  const SkinSettings& settings_;
  float tone_luminance_;
  float redness_response_;  // relative to light skin
  float freckle_strength_;
  float make_up_cover_;
  std::uint32_t mottle_key_, freckle_key_, mole_key_, hair_key_;
};

}  // namespace faceprobe::synth
