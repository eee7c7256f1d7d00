#pragma once
// Hats and scarves, and what they do to the hair below.

#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/anatomy.h"
#include "synth/wardrobe/skin_field.h"

#include <array>
#include <vector>

namespace faceprobe::synth {

// The surface of a hat as distances from the middle of the skull, above a rim. Empty: no hat.
class HatShell {
 public:
  HatShell() = default;
  // Rim heights (y) at the front, over the ears and at the back; `slack(elevation, azimuth)` is the room over the skin.
  struct Rim {
    float front, side, back;
  };
  HatShell(const Anatomy& anatomy, const SkinField& field, const Rim& rim);

  bool empty() const { return radius_.empty(); }
  float rim_elevation(float azimuth) const;
  Eigen::Vector3f direction(float azimuth, float elevation) const;
  // Distance to the skin (hull over the ears) in a direction.
  float skin_radius(float azimuth, float elevation) const;
  const Eigen::Vector3f& centre() const { return centre_; }
  // Whether p is under the hat; if so it is pressed below `slack_m` over the skin.
  bool press(Eigen::Vector3f& p, float slack_m) const;

 private:
  static constexpr int kAzimuths = 72;
  static constexpr int kElevations = 24;
  Eigen::Vector3f centre_{0, 0, 0};
  std::array<float, kAzimuths> rim_{};
  std::vector<float> radius_;  // by elevation, then azimuth
};

// A beanie or a cap. `skin` holds the skin.
HatShell add_hat(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& skin, Figure& out);
// A scarf over hair, ears and neck. `field` holds skin and clothes.
void add_scarf(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, Figure& out);

}  // namespace faceprobe::synth
