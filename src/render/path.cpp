#include "render/path.h"

#include "render/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::render {
namespace {

constexpr int kSurePaths = 3;  // bounces before a path may end by chance

// Power heuristic of Veach & Guibas 1995 for one sample of each way.
float share_of(float mine, float other) {
  const float a = mine * mine;
  return a / (a + other * other);
}

Eigen::Vector3f limited(const Eigen::Vector3f& light, float limit) {
  const float most = light.maxCoeff();
  return limit > 0 && most > limit ? Eigen::Vector3f(light * (limit / most)) : light;
}

bool is_black(const Eigen::Vector3f& colour) { return !(colour.maxCoeff() > 0); }

// A ray on its way from one surface to the next.
struct Ray {
  Eigen::Vector3f origin, direction;
  float density = 0;     // of the surface's own draw; 0 = picked, so that no light was drawn for it
  bool straight = true;  // nothing but mirrors and glass since the camera
};

// The photo where a straight ray leaves through its view, else the map.
Eigen::Vector3f seen_far_away(const PathScene& scene, const Ray& ray, const Eigen::Vector3f& map) {
  if (!scene.options.backdrop || !ray.straight || ray.direction.z() >= 0) return map;
  const auto& [view, photo] = *scene.options.backdrop;
  const double scale = view.focal_px / -static_cast<double>(ray.direction.z());
  const double x = view.centre_x_px + scale * static_cast<double>(ray.direction.x());
  const double y = view.centre_y_px - scale * static_cast<double>(ray.direction.y());
  if (!(x >= 0 && y >= 0 && x < photo.width() && y < photo.height())) return map;
  return Eigen::Map<const Eigen::Vector3f>(photo.pixel(static_cast<int>(x), static_cast<int>(y)));
}

// Light that a ray finds by itself: of the lamps that it meets before the surface it hits, and of the map where it hits none.
Eigen::Vector3f met_light(const PathScene& scene, const Ray& ray, bool hit, float hit_distance) {
  const auto share = [&](float density) { return ray.density > 0 ? share_of(ray.density, density) : 1.0F; };
  Eigen::Vector3f light = Eigen::Vector3f::Zero();
  if (scene.lights.has_lamps()) {
    const LightSet::Seen lamp = scene.lights.lamp_along(ray.origin, ray.direction, hit ? hit_distance : kFar);
    if (lamp.density > 0) light = lamp.radiance * share(lamp.density);
  }
  if (hit) return light;
  const LightSet::Seen far = scene.lights.map_along(ray.direction);
  return light + seen_far_away(scene, ray, far.radiance) * share(far.density);
}

// One light, drawn for a surface.
struct DirectLight {
  LightSet::Seen seen;
  Eigen::Vector3f value = Eigen::Vector3f::Zero();  // if nothing is in the way
  Eigen::Vector3f start = Eigen::Vector3f::Zero();
};
DirectLight draw_direct(const PathScene& scene, const SurfaceHit& at, SobolSampler& random) {
  const float choice = scene.lights.has_lamps() ? random.one() : 1;
  DirectLight out{scene.lights.draw(at.position, choice, random.pair())};
  if (!(out.seen.density > 0) || out.seen.direction.dot(at.face) <= 0) return out;
  const Eigen::Vector3f value = at.bsdf.value(out.seen.direction);
  if (is_black(value)) return out;
  const float share = share_of(out.seen.density, at.bsdf.density(out.seen.direction));
  out.value = share / out.seen.density * value.cwiseProduct(out.seen.radiance);
  out.start = RayScene::start(at.position, at.face, out.seen.direction);
  return out;
}

// The light that a surface sends along at.bsdf.view.
Eigen::Vector3f follow(const PathScene& scene, SurfaceHit at, bool straight, int bounce, SobolSampler& random) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Vector3f throughput = Eigen::Vector3f::Ones();
  for (;; ++bounce) {
    const float limit = straight ? 0 : scene.clamp_indirect;
    if (!at.bsdf.only_picks_directions()) {
      const DirectLight direct = draw_direct(scene, at, random);
      if (!is_black(direct.value) && !scene.rays.occluded(direct.start, direct.seen.direction, direct.seen.distance))
        sum += limited(throughput.cwiseProduct(direct.value), limit);
    }
    const float choice = random.one();
    const Bsdf::Draw draw = at.bsdf.draw(choice, random.pair());
    // A smooth normal may send light through the surface: that is lost.
    const bool through = draw.light.dot(at.face) <= 0;
    if (is_black(draw.weight) || (through && at.bsdf.finish->material.kind != MaterialKind::kGlass)) return sum;
    throughput = throughput.cwiseProduct(draw.weight);
    straight = straight && draw.density == 0;
    const Ray ray{RayScene::start(at.position, at.face, draw.light), draw.light, draw.density, straight};
    const bool hit = scene.rays.hit(ray.origin, ray.direction, at);
    sum += limited(throughput.cwiseProduct(met_light(scene, ray, hit, at.distance)), limit);
    if (!hit || bounce + 1 >= scene.max_bounces) return sum;
    if (bounce + 1 >= kSurePaths) {
      const float alive = std::min(0.95F, throughput.maxCoeff());
      if (random.one() >= alive) return sum;
      throughput /= alive;
    }
  }
}

// The ground with the model and without it, of the same draws, so that where the model changes nothing the two are equal.
void light_ground(const PathScene& scene, SurfaceHit at, SobolSampler& random, PathSample& out) {
  at.bsdf.colour.setOnes();
  const DirectLight direct = draw_direct(scene, at, random);
  out.open = direct.value;
  if (!is_black(direct.value) && !scene.rays.occluded(direct.start, direct.seen.direction, direct.seen.distance, false))
    out.light = direct.value;
  const Bsdf::Draw own = at.bsdf.draw(0, random.pair());
  if (is_black(own.weight)) return;
  const Ray ray{RayScene::start(at.position, at.face, own.light), own.light, own.density, false};
  Eigen::Vector3f light = met_light(scene, ray, false, kFar);
  out.open += own.weight.cwiseProduct(light);
  SurfaceHit next;
  if (scene.rays.hit(ray.origin, ray.direction, next)) {
    light = met_light(scene, ray, true, next.distance) +
            limited(follow(scene, next, false, 1, random), scene.clamp_indirect);
  }
  out.light += own.weight.cwiseProduct(light);
}

}  // namespace

PathSample trace_path(const PathScene& scene, const Eigen::Vector3f& direction, SobolSampler& random) {
  PathSample out;
  SurfaceHit at;
  if (!scene.rays.hit(Eigen::Vector3f::Zero(), direction, at)) return out;
  if (at.ground) {
    out.first = PathSample::First::kGround;
    light_ground(scene, at, random, out);
    return out;
  }
  out.first = PathSample::First::kModel;
  out.depth = -at.position.z();
  out.normal = at.bsdf.normal;
  if (at.bsdf.has_halves()) {
    SurfaceHit mirrored = at;
    mirrored.bsdf.half = Bsdf::Half::kMirrored;
    out.light = follow(scene, mirrored, true, 0, random);
    at.bsdf.half = Bsdf::Half::kRest;
  }
  out.light += follow(scene, at, true, 0, random);
  return out;
}

}  // namespace faceprobe::render
