#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "synth/generate/group.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace faceprobe::synth {
namespace {

constexpr float kClearance = 0.55F;  // metres between a lamp and a face at least
constexpr int kTries = 200;
constexpr int kTriesAsked = 20'000;               // for lamps that have to be there
constexpr double kLowest = -0.4, kHighest = 1.6;  // metres above the eyes
constexpr double kMostAside = 80;  // degrees from straight ahead of the group, of lamps at a distance that is asked for

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

// From the middle of the faces; the camera is as far in front of them as it is from that middle.
Eigen::Vector3d draw_place(const Recipe& recipe, double camera_m, Random& random) {
  if (!recipe.lamp_distance_m) {
    // Braces or names would order these draws otherwise than older data sets have them.
    return Eigen::Vector3d(random.between(-2.2, 2.2), random.between(kLowest, kHighest),
                           random.between(0.2, camera_m + 1.2));
  }
  const double distance = random.between((*recipe.lamp_distance_m)[0], (*recipe.lamp_distance_m)[1]);
  const double up = std::min(random.between(kLowest, kHighest), 0.95 * distance);
  const double level = std::sqrt(distance * distance - up * up);
  const double azimuth = random.between(-radians(kMostAside), radians(kMostAside));
  return {level * std::sin(azimuth), up, level * std::cos(azimuth)};
}

// The lamp's middle from every face.
bool at_asked_distance(const Recipe& recipe, const NearLight& lamp, std::span<const Person> people) {
  if (!recipe.lamp_distance_m) return true;
  const double low = (*recipe.lamp_distance_m)[0];
  const double high = (*recipe.lamp_distance_m)[1];
  return std::ranges::all_of(people, [&](const Person& person) {
    const double distance = (lamp.position - person.scene_from_head.translation()).cast<double>().norm();
    return distance >= low && distance <= high;
  });
}

[[noreturn]] void no_place(const Recipe& recipe, int wanted) {
  std::ostringstream text;
  text << "There is no place for " << wanted << " lamps";
  if (recipe.lamp_distance_m)
    text << " at " << (*recipe.lamp_distance_m)[0] << " to " << (*recipe.lamp_distance_m)[1] << " m from every face";
  text << " that the camera does not see; ask for fewer, or for a wider range of distances.";
  throw Error(ExitCode::kUsage, text.str());
}

}  // namespace

std::vector<NearLight> draw_lamps(std::span<const Person> people, const PinholeCamera& camera, const Recipe& recipe,
                                  Random& random) {
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();
  for (const Person& person : people)
    middle += person.scene_from_head.translation() / static_cast<float>(people.size());
  const int drawn = 1 + random.below(3);
  const int wanted = recipe.lamps.value_or(drawn);
  const bool asked = recipe.lamps || recipe.lamp_distance_m;
  const int tries = asked ? kTriesAsked : kTries;
  std::vector<NearLight> lamps;
  std::vector<float> shares;
  for (int attempt = 0; attempt < tries && static_cast<int>(lamps.size()) < wanted; ++attempt) {
    NearLight lamp;
    lamp.radius = static_cast<float>(random.log_between(0.02, 0.15));
    lamp.position = middle + draw_place(recipe, static_cast<double>(-middle.z()), random).cast<float>();
    const Eigen::Vector3f colour = draw_colour(random);
    const auto share = static_cast<float>(random.log_between(0.25, 1.0));
    if (in_picture(camera, lamp) || !serves(lamp, people) || !at_asked_distance(recipe, lamp, people)) continue;
    lamp.radiance = colour;
    lamps.push_back(lamp);
    shares.push_back(share);
  }
  if (asked && static_cast<int>(lamps.size()) < wanted) no_place(recipe, wanted);
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
