#include "faceprobe/lighting/triangulate.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "lighting/lamp_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace faceprobe::lighting {
namespace {

const MainLight& light_of(const std::vector<FaceLights>& faces, const Sighting& s) {
  return faces[static_cast<std::size_t>(s.face)].lights[static_cast<std::size_t>(s.light)];
}

using Used = std::set<std::pair<int, int>>;

// Of each face that has not voted the light that is nearest to where the lamp would be seen, if it is near enough and of its colour.
std::vector<Sighting> supporters(const std::vector<FaceLights>& faces, const LampFit& fit,
                                 const Eigen::Vector3d& colour, const std::vector<Sighting>& pair, const Used& used,
                                 const TriangulateOptions& options) {
  std::vector<Sighting> seen = pair;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const bool voted = std::ranges::any_of(pair, [f](const Sighting& s) { return s.face == f; });
    if (voted) continue;
    const FaceLights& face = faces[static_cast<std::size_t>(f)];
    const Eigen::Vector3d towards = fit.seen_from(face.position_m);
    int best = -1;
    double best_deg = options.max_miss_deg;
    for (int i = 0; i < static_cast<int>(face.lights.size()); ++i) {
      const MainLight& light = face.lights[static_cast<std::size_t>(i)];
      const double miss = angle_between_deg(light.direction, towards);
      if (used.contains({f, i}) || miss >= best_deg || angle_between_deg(light.colour, colour) > options.max_colour_deg)
        continue;
      best = i;
      best_deg = miss;
    }
    if (best >= 0) seen.push_back({f, best});
  }
  return seen;
}

struct Candidate {
  std::vector<Sighting> seen;
  LampFit near, distant;
  bool is_near = false;

  const LampFit& fit() const { return is_near ? near : distant; }
};

bool plausible(const std::vector<FaceLights>& faces, const LampFit& fit, const std::vector<Sighting>& seen,
               const TriangulateOptions& options) {
  return std::ranges::all_of(seen, [&](const Sighting& s) {
    const Eigen::Vector3d& from = faces[static_cast<std::size_t>(s.face)].position_m;
    const double distance = (fit.position_m - from).norm();
    const bool in_room = !fit.near || (distance >= options.least_m && distance <= options.most_m);
    return in_room && angle_between_deg(light_of(faces, s).direction, fit.seen_from(from)) <= options.max_miss_deg;
  });
}

// The lamp that two lights would be, and all that see it.
std::optional<Candidate> candidate_of(const std::vector<FaceLights>& faces, const Sighting& a, const Sighting& b,
                                      const Used& used, const TriangulateOptions& options) {
  const Eigen::Vector3d colour = light_of(faces, a).colour;
  if (angle_between_deg(colour, light_of(faces, b).colour) > options.max_colour_deg) return std::nullopt;
  Candidate out;
  const std::vector<Sighting> pair = {a, b};
  const LampFit first_near = fit_near_lamp(faces, pair, options);
  const LampFit first_distant = fit_distant_lamp(faces, pair, options);
  const bool near_works = plausible(faces, first_near, pair, options);
  const bool distant_works = plausible(faces, first_distant, pair, options);
  if (!near_works && !distant_works) return std::nullopt;
  const LampFit& first =
      near_works && (!distant_works || first_near.cost < first_distant.cost) ? first_near : first_distant;
  out.seen = supporters(faces, first, colour, pair, used, options);
  out.near = fit_near_lamp(faces, out.seen, options);
  out.distant = fit_distant_lamp(faces, out.seen, options);
  const bool near = plausible(faces, out.near, out.seen, options);
  const bool distant = plausible(faces, out.distant, out.seen, options);
  if (!near && !distant) return std::nullopt;
  out.is_near = near && (!distant || out.distant.cost - out.near.cost >= options.least_gain);
  return out;
}

// More faces first, then the better fit.
bool better(const Candidate& a, const Candidate& b) {
  if (a.seen.size() != b.seen.size()) return a.seen.size() > b.seen.size();
  return a.fit().cost < b.fit().cost;
}

Lamp lamp_of(const std::vector<FaceLights>& faces, const Candidate& candidate) {
  const LampFit& fit = candidate.fit();
  Lamp lamp;
  lamp.near = candidate.is_near;
  lamp.seen = candidate.seen;
  lamp.position_m = fit.position_m;
  lamp.covariance_m2 = fit.covariance_m2;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  double log_intensity = 0;
  double miss = 0;
  for (const Sighting& s : candidate.seen) {
    const Eigen::Vector3d& from = faces[static_cast<std::size_t>(s.face)].position_m;
    const MainLight& light = light_of(faces, s);
    const double distance = lamp.near ? (fit.position_m - from).norm() : 1;
    middle += from;
    colour += light.irradiance * light.colour;
    log_intensity += std::log(light.irradiance * distance * distance);
    miss += std::pow(angle_between_deg(light.direction, fit.seen_from(from)), 2);
  }
  const auto count = static_cast<double>(candidate.seen.size());
  lamp.direction = fit.seen_from(middle / count);
  lamp.colour = colour / luminance(colour.data());
  lamp.intensity = std::exp(log_intensity / count);
  lamp.miss_deg = std::sqrt(miss / count);
  return lamp;
}

struct Pair {
  Sighting a, b;
  std::optional<Candidate> candidate;
};

std::vector<Pair> all_pairs(const std::vector<FaceLights>& faces, const TriangulateOptions& options) {
  std::vector<Pair> pairs;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    for (int g = f + 1; g < static_cast<int>(faces.size()); ++g) {
      for (int i = 0; i < static_cast<int>(faces[static_cast<std::size_t>(f)].lights.size()); ++i) {
        for (int j = 0; j < static_cast<int>(faces[static_cast<std::size_t>(g)].lights.size()); ++j) {
          const Sighting a{f, i};
          const Sighting b{g, j};
          pairs.push_back({a, b, candidate_of(faces, a, b, {}, options)});
        }
      }
    }
  }
  return pairs;
}

bool taken(const std::vector<Sighting>& seen, const Used& used) {
  return std::ranges::any_of(seen, [&](const Sighting& s) { return used.contains({s.face, s.light}); });
}

}  // namespace

std::string TriangulateOptions::validate() const {
  if (!(direction_error_deg > 0 && direction_error_deg <= 90)) return "direction_error_deg must lie in (0, 90].";
  if (!(log_strength_error > 0 && log_strength_error < 100)) return "log_strength_error must lie in (0, 100).";
  if (!(max_colour_deg > 0 && max_colour_deg <= 180)) return "max_colour_deg must lie in (0, 180].";
  if (!(max_miss_deg > 0 && max_miss_deg <= 180)) return "max_miss_deg must lie in (0, 180].";
  if (!(least_m > 0 && most_m > least_m && most_m < 1e6)) return "least_m and most_m must be positive and in order.";
  if (!(least_gain >= 0 && least_gain < 1e6)) return "least_gain must not be negative.";
  return {};
}

std::vector<Lamp> triangulate(const std::vector<FaceLights>& faces, const TriangulateOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  std::vector<Lamp> lamps;
  Used used;
  std::vector<Pair> pairs = all_pairs(faces, options);
  while (true) {
    const Candidate* best = nullptr;
    for (Pair& pair : pairs) {
      if (used.contains({pair.a.face, pair.a.light}) || used.contains({pair.b.face, pair.b.light})) continue;
      // What another lamp has taken since cannot vote for this one any more.
      if (pair.candidate && taken(pair.candidate->seen, used))
        pair.candidate = candidate_of(faces, pair.a, pair.b, used, options);
      if (pair.candidate && (best == nullptr || better(*pair.candidate, *best))) best = &*pair.candidate;
    }
    if (best == nullptr) break;
    for (const Sighting& s : best->seen) used.insert({s.face, s.light});
    lamps.push_back(lamp_of(faces, *best));
  }
  std::stable_sort(lamps.begin(), lamps.end(), [](const Lamp& a, const Lamp& b) {
    return a.seen.size() != b.seen.size() ? a.seen.size() > b.seen.size() : a.intensity > b.intensity;
  });
  return lamps;
}

}  // namespace faceprobe::lighting
