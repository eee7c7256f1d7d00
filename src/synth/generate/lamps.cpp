#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "synth/generate/group.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr float kClearance = 0.55F;  // metres between a lamp and a face at least
constexpr int kTries = 200;

// Colour of a lamp, luminance 1: from candle-like to overcast daylight, with the green or magenta cast of cheap lamps. The ends are
// the black body's at 2000 K and 9000 K in linear Rec.709.
Eigen::Vector3f draw_colour(Random& random) {
  const Eigen::Vector3f warm(2.55F, 0.67F, 0.04F);
  const Eigen::Vector3f cool(0.83F, 1.01F, 1.42F);
  const auto share = static_cast<float>(std::pow(random.uniform(), 0.7));
  Eigen::Vector3f colour = (1.0F - share) * warm + share * cool;
  colour.y() *= static_cast<float>(std::exp(random.normal(0, 0.04)));
  return colour / colour.dot(kLuminanceWeights);
}

bool in_picture(const PinholeCamera& camera, const NearLight& lamp) {
  const Eigen::Vector3f at = camera.camera_from_scene * lamp.position;
  if (at.z() > -0.05F) return false;  // beside or behind the camera
  const float reach = lamp.radius * camera.focal_px / -at.z();
  const Eigen::Vector2f pixel = camera.project(at);
  return pixel.x() > -reach && pixel.y() > -reach && pixel.x() < static_cast<float>(camera.width_px) + reach &&
         pixel.y() < static_cast<float>(camera.height_px) + reach;
}

// A lamp is of use where it shines on the fronts of faces, and must not stand in anybody's.
bool serves(const NearLight& lamp, std::span<const Person> people) {
  int lit = 0;
  for (const Person& person : people) {
    const Eigen::Vector3f to_lamp = lamp.position - person.scene_from_head.translation();
    if (to_lamp.norm() < kClearance + lamp.radius) return false;
    lit += to_lamp.normalized().dot(person.scene_from_head.linear().col(2)) > 0.15F ? 1 : 0;
  }
  return 2 * lit > static_cast<int>(people.size());
}

}  // namespace

std::vector<NearLight> draw_lamps(std::span<const Person> people, const PinholeCamera& camera, Random& random) {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const Person& person : people)
    middle += person.scene_from_head.translation() / static_cast<float>(people.size());
  const int wanted = 1 + random.below(3);
  std::vector<NearLight> lamps;
  std::vector<float> shares;
  for (int attempt = 0; attempt < kTries && static_cast<int>(lamps.size()) < wanted; ++attempt) {
    NearLight lamp;
    lamp.radius = static_cast<float>(random.log_between(0.02, 0.15));
    lamp.position = middle + Eigen::Vector3d(random.between(-2.2, 2.2), random.between(-0.4, 1.6),
                                             random.between(0.2, static_cast<double>(-middle.z()) + 1.2))
                                 .cast<float>();
    const Eigen::Vector3f colour = draw_colour(random);
    const auto share = static_cast<float>(random.log_between(0.25, 1.0));
    if (in_picture(camera, lamp) || !serves(lamp, people)) continue;
    lamp.radiance = colour;
    lamps.push_back(lamp);
    shares.push_back(share);
  }
  float sum = 0;
  for (const float share : shares) sum += share;
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    // A sphere of radiance L gives a surface that faces it the irradiance pi L (radius / distance)^2.
    const float ratio = lamps[l].radius / (lamps[l].position - middle).norm();
    lamps[l].radiance *= shares[l] / sum / (static_cast<float>(kPi) * ratio * ratio);
  }
  return lamps;
}

}  // namespace faceprobe::synth
