#include "synth/wardrobe/glasses.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/draw.h"
#include "synth/wardrobe/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

struct Design {
  float half_width, half_height;  // of a lens
  float squareness;               // exponent of its outline; 2 = ellipse
  float taper;                    // narrower below
  float bar;                      // radius of the frame
  bool rimless_below = false;
  Eigen::Vector3f colour{0.02F, 0.02F, 0.02F};
};

Design draw_design(Glasses kind, Random& random) {
  Design d{};
  switch (kind) {
    case Glasses::kNone: break;
    case Glasses::kRound:
      d = {draw(random, 0.021, 0.0245), 0, draw(random, 2.0, 2.4), 0.0F, draw(random, 0.0007, 0.0019), false};
      d.half_height = d.half_width * draw(random, 0.9, 1.0);
      break;
    case Glasses::kSquare:
      d = {draw(random, 0.0245, 0.0275), draw(random, 0.016, 0.0205),  draw(random, 2.8, 4.5),
           draw(random, 0.0, 0.12),      draw(random, 0.0009, 0.0024), random.chance(0.2)};
      break;
    case Glasses::kSun:
      d = {draw(random, 0.026, 0.030), draw(random, 0.020, 0.0245), draw(random, 2.2, 3.6),
           draw(random, 0.0, 0.25),    draw(random, 0.001, 0.0026), false};
      break;
  }
  const double look = random.uniform();
  if (look < 0.55) {
    d.colour = Eigen::Vector3f::Constant(draw(random, 0.008, 0.03));  // black
  } else if (look < 0.75) {
    d.colour = {0.10F, 0.045F, 0.018F};  // tortoiseshell
  } else if (look < 0.9) {
    d.colour = {0.35F, 0.33F, 0.30F};  // metal
  } else {
    d.colour = {draw(random, 0.02, 0.4), draw(random, 0.02, 0.2), draw(random, 0.02, 0.4)};
  }
  return d;
}

// A lens' frame: x outwards from the nose, y up, z forwards.
struct LensPlane {
  Eigen::Vector3f centre;
  Eigen::Matrix3f axes;  // columns
  Eigen::Vector3f at(float x, float y, float z = 0) const { return centre + axes * Eigen::Vector3f(x, y, z); }
};

LensPlane lens_plane(const Anatomy& a, float side, const Design& design) {
  const float s = a.scale;
  const Eigen::Vector3f left = a.landmark_mean(42, 6);
  const Eigen::Vector3f right = a.landmark_mean(36, 6);
  const Eigen::Vector3f middle = 0.5F * (left + right);  // one height and distance for both lenses
  const float half = 0.5F * (left - right).norm();
  LensPlane plane;
  // The bridge leaves room for a nose between the lenses.
  const float x = std::max(half * 1.02F, design.half_width * s + 0.0075F * s);
  plane.centre = Eigen::Vector3f(middle.x() + side * x, middle.y() - 0.003F * s, middle.z() + 0.015F * s);
  const float wrap = static_cast<float>(radians(7));
  const float tilt = static_cast<float>(radians(8));
  const Eigen::Vector3f z = Eigen::Vector3f(side * std::sin(wrap), -std::sin(tilt), 1.0F).normalized();
  const Eigen::Vector3f y = (Eigen::Vector3f(0, 1, 0) - z * z.y()).normalized();
  plane.axes.col(0) = side * y.cross(z);
  plane.axes.col(1) = y;
  plane.axes.col(2) = z;
  return plane;
}

// Outline, counter-clockwise seen from the front.
std::vector<Eigen::Vector3f> outline(const LensPlane& plane, const Design& design, float side, float s, int count) {
  std::vector<Eigen::Vector3f> points;
  const float exponent = 2.0F / design.squareness;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    const auto c = static_cast<float>(std::cos(angle));
    const auto n = static_cast<float>(std::sin(angle));
    const float y = std::copysign(std::pow(std::abs(n), exponent), n) * design.half_height * s;
    const float narrow = 1.0F - design.taper * std::max(0.0F, -y / (design.half_height * s));
    const float x = std::copysign(std::pow(std::abs(c), exponent), c) * design.half_width * s * narrow;
    points.push_back(plane.at(side * x, y));
  }
  return points;
}

// How far a lens has to come forward to clear the skin behind it.
float step_forward(const Anatomy& a, const LensPlane& plane, const Design& design) {
  const float s = a.scale;
  float needed = 0;
  for (const auto& row : a.skin.vertices.rowwise()) {
    if (row.z() < a.ear_front) continue;
    const Eigen::Vector3f q = plane.axes.transpose() * (row.transpose() - plane.centre);
    // The nose may come close to the inner rim: that is where glasses sit.
    if (q.x() < -0.75F * design.half_width * s || q.x() > design.half_width * s ||
        std::abs(q.y()) > design.half_height * s)
      continue;
    needed = std::max(needed, q.z() + 0.002F * s + design.bar * s);
  }
  return std::min(needed, 0.012F * s);
}

Reflectance frame_reflectance(const Design& design) {
  const bool metal = design.colour.minCoeff() > 0.25F;
  return {design.colour, metal ? 0.15F : 0.2F, metal ? 1.0F : 0.6F, metal ? 0.5F : 0.045F};
}

}  // namespace

void add_glasses(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Figure& out) {
  if (settings.glasses == Glasses::kNone) return;
  Random random({settings.seed, 0x61a5});
  const Design design = draw_design(settings.glasses, random);
  const float s = a.scale;
  std::array<LensPlane, 2> planes = {lens_plane(a, -1, design), lens_plane(a, 1, design)};
  const float forward = std::max(step_forward(a, planes[0], design), step_forward(a, planes[1], design));
  const float mask = settings.held == Held::kMask ? 0.006F * s : 0.0F;  // they sit on it
  MeshBuilder frame;
  MeshBuilder lenses;
  for (int i = 0; i < 2; ++i) {
    LensPlane& plane = planes[static_cast<std::size_t>(i)];
    const float side = i == 0 ? -1.0F : 1.0F;
    plane.centre.z() += forward + mask;
    const std::vector<Eigen::Vector3f> rim = outline(plane, design, side, s, 36);
    if (design.rimless_below) {
      frame.tube(std::span(rim).subspan(0, 19), design.bar * s, 7);
    } else {
      frame.tube(rim, design.bar * s, 7, true);
    }
    lenses.disc(rim, plane.axes.col(2) * 0.0015F * s);

    // The bar to the ear: along the temple, over the ear, down behind it.
    const Eigen::Vector3f hinge = plane.at(0.97F * design.half_width * s, 0.35F * design.half_height * s);
    const float ear_x = std::max(a.skull_radii.x(), std::abs(a.landmark(i == 0 ? 0 : 16).x()) + 0.002F * s);
    const float ear_y = a.ear_top + 0.001F * s;
    const float out_x = std::abs(hinge.x()) + 0.0045F * s;
    const float half_way = 0.5F * (hinge.z() + a.ear_front);
    const float behind = a.ear_front + 0.65F * (a.ear_back - a.ear_front);
    const std::array<Eigen::Vector3f, 6> knots = {
        hinge,
        Eigen::Vector3f(side * out_x, hinge.y(), hinge.z() - 0.005F * s),
        Eigen::Vector3f(side * 0.5F * (out_x + ear_x), 0.6F * hinge.y() + 0.4F * ear_y, half_way),
        Eigen::Vector3f(side * ear_x, ear_y, a.ear_front - 0.006F * s),
        Eigen::Vector3f(side * a.skull_radii.x(), ear_y - 0.002F * s, behind),
        Eigen::Vector3f(side * a.skull_radii.x(), ear_y - 0.022F * s, a.ear_back)};
    std::vector<Eigen::Vector3f> bar = smooth_path(knots, 5);
    for (std::size_t k = 5; k < 18; ++k) field.push_out(bar[k], design.bar * s);
    frame.tube(bar, std::max(design.bar, 0.0009F) * s, 7);
  }
  const Eigen::Vector3f right = planes[0].at(-0.97F * design.half_width * s, 0.3F * design.half_height * s);
  const Eigen::Vector3f left = planes[1].at(-0.97F * design.half_width * s, 0.3F * design.half_height * s);
  const float nose = a.landmark(27).z() + 0.004F * s + design.bar * s;
  Eigen::Vector3f arch = 0.5F * (left + right) + Eigen::Vector3f(0, 0.0015F * s, 0.002F * s);
  arch.z() = std::max(arch.z(), nose);
  const std::array<Eigen::Vector3f, 3> bridge = {right, arch, left};
  frame.tube(smooth_path(bridge, 5), design.bar * s, 7);

  out.meshes.push_back(frame.take(Material::kFrame, Region::kGlasses, frame_reflectance(design)));
  if (settings.glasses == Glasses::kSun) {
    const Eigen::Vector3f tint(draw(random, 0.004, 0.02), draw(random, 0.004, 0.012), draw(random, 0.004, 0.012));
    out.meshes.push_back(lenses.take(Material::kObject, Region::kGlasses, {tint, 0.08F, 1.0F, 0.05F}));
  } else {
    out.meshes.push_back(lenses.take(Material::kLens, Region::kGlasses, {Eigen::Vector3f::Zero(), 0.05F, 1.0F, 0.04F}));
  }
}

}  // namespace faceprobe::synth
