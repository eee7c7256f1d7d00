#include "faceprobe/render/shapes.h"
#include "loft.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/smooth_step.h"

#include <cmath>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr float kHeight = 3.15F;  // of the pot in the units below, which are those of Newell's teapot of 1975
constexpr int kColumns = 96;

using Point = Eigen::Vector2f;

TriangleMesh body() {
  Profile outline(Point(0, 0));
  outline.line({1.38F, 0}).curve({1.45F, 0}, {1.5F, 0.06F}, {1.5F, 0.15F}, 6);  // base
  outline.curve({1.5F, 0.27F}, {2, 0.42F}, {2, 0.9F}, 24).curve({2, 1.35F}, {1.75F, 1.875F}, {1.5F, 2.4F}, 24);
  outline.curve({1.4375F, 2.53125F}, {1.3375F, 2.53125F}, {1.4F, 2.4F});  // rim
  outline.line({1.42F, 2.3F}).line({0, 2.3F});                            // closed under the lid
  return lathe(outline.points(), kColumns);
}

TriangleMesh lid() {
  Profile outline(Point(0, 2.28F));
  outline.line({1.32F, 2.28F}).line({1.36F, 2.42F});
  outline.curve({1.31F, 2.62F}, {0.5F, 2.62F}, {0.3F, 2.74F}, 24);
  outline.curve({0.175F, 2.815F}, {0.116F, 2.858F}, {0.2F, 2.93F}, 12);  // neck of the knob
  outline.curve({0.361F, 3.068F}, {0.34F, 3.15F}, {0, 3.15F}, 24);
  return lathe(outline.points(), kColumns);
}

// Half-way between two curves of the x-y plane and touching both, `half_width` wide to either side.
Ring ring_between(const Bezier<2>& upper, const Bezier<2>& lower, float t, float half_width) {
  const Point high = upper.at(t);
  const Point low = lower.at(t);
  Ring ring;
  ring.centre << (high + low) / 2, 0;
  ring.a << (high - low) / 2, 0;
  ring.b = {0, 0, half_width};
  return ring;
}

void close_end(std::vector<Ring>& rings) {
  const Ring last = rings.back();
  rings.push_back(last);
  rings.push_back({last.centre, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()});
}

std::vector<Ring> begin_end(const Ring& first) {
  return {{first.centre, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()}, first};
}

Ring scaled(const Ring& ring, float scale, float along) {
  return {ring.centre + along * ring.a.cross(ring.b).normalized(), scale * ring.a, scale * ring.b};
}

TriangleMesh spout() {
  const Bezier<2> upper{{1.6F, 1.35F}, {2.55F, 1.4F}, {2.25F, 2.0F}, {2.72F, 2.4F}};
  const Bezier<2> lower{{1.6F, 0.42F}, {3.2F, 0.6F}, {2.4F, 2.0F}, {3.28F, 2.4F}};
  const auto ring_at = [&](float t) {
    const float tip = smooth_step(0.0F, 1.0F, t);
    return ring_between(upper, lower, t, 0.52F * (1 - tip) + 0.2F * tip);
  };
  constexpr int kSteps = 40;
  std::vector<Ring> rings = begin_end(ring_at(0));
  for (int i = 0; i <= kSteps; ++i) rings.push_back(ring_at(static_cast<float>(i) / kSteps));
  // Over the lip, which has an edge to either side, and back down inside.
  constexpr float kWall = 0.2F;  // of the mouth's radius
  constexpr int kLip = 10;
  const Ring mouth = ring_at(1);
  rings.push_back(mouth);
  for (int i = 1; i <= kLip; ++i) {
    const auto angle = static_cast<float>(kPi * i / kLip);
    rings.push_back(scaled(mouth, 1 - kWall / 2 * (1 - std::cos(angle)), 0.03F * std::sin(angle)));
  }
  const Ring inside = rings.back();
  rings.push_back(inside);
  for (int i = kSteps - 1; i > kSteps / 2; --i) {
    rings.push_back(scaled(ring_at(static_cast<float>(i) / kSteps), 1 - kWall, 0));
  }
  close_end(rings);
  return loft(rings, 64);
}

TriangleMesh handle() {
  const Bezier<2> upper[2] = {{{-1.4F, 2.24F}, {-2.5F, 2.26F}, {-3, 2.25F}, {-3, 1.8F}},
                              {{-3, 1.8F}, {-3, 1.35F}, {-2.65F, 0.9375F}, {-1.8F, 0.58F}}};
  const Bezier<2> lower[2] = {{{-1.4F, 1.98F}, {-2.4F, 2.02F}, {-2.7F, 2.02F}, {-2.7F, 1.8F}},
                              {{-2.7F, 1.8F}, {-2.7F, 1.575F}, {-2.5F, 1.125F}, {-1.8F, 0.82F}}};
  constexpr float kHalfWidth = 0.19F;
  constexpr int kSteps = 32;
  std::vector<Ring> rings;
  for (int i = 0; i <= 2 * kSteps; ++i) {
    const int half = i < kSteps ? 0 : 1;
    const float t = static_cast<float>(i - half * kSteps) / kSteps;
    // The handle runs to the left and then back, so that its outer side is the upper one all along.
    Ring ring = ring_between(lower[half], upper[half], t, kHalfWidth);
    if (i == 0) rings = begin_end(ring);
    rings.push_back(ring);
  }
  close_end(rings);
  return loft(rings, 40);
}

}  // namespace

Model pot() {
  Model model;
  model.materials = {material_preset("plastic")};
  model.meshes = {body(), lid(), spout(), handle()};
  transform(model, Eigen::Affine3f(Eigen::Scaling(1 / kHeight)));
  return model;
}

}  // namespace faceprobe::render
