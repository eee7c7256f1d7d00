#include "synth/wardrobe/hair_guides.h"

#include "synth/wardrobe/noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Hair that hangs parts in front of the face: it is pushed aside where the eyes, nose and mouth are.
Eigen::Vector3f off_the_face(const Anatomy& anatomy, const Eigen::Vector3f& p, int side) {
  const float s = anatomy.scale;
  const float brow = anatomy.brow_y();
  if (p.z() < anatomy.ear_front + 0.01F * s || p.y() > brow + 0.045F * s) return Eigen::Vector3f::Zero();
  const float half_width = 0.066F * s;
  const float depth = half_width - std::abs(p.x());
  if (depth < 0) return Eigen::Vector3f::Zero();
  const float sign = side != 0 && side != 2 ? static_cast<float>(side) : std::copysign(1.0F, p.x());
  return std::min(1.0F, depth / (0.02F * s)) * Eigen::Vector3f(sign, 0, -0.3F);
}

}  // namespace

Guide grow(const HairStyle& style, const Anatomy& anatomy, const SkinField& field, const Scalp::Root& root,
           Random& random) {
  const float s = anatomy.scale;
  Guide guide;
  guide.root = root.position;
  guide.side = side_of(style, anatomy, root.position);
  const float length = length_at(style, anatomy, root.position);
  const float step = length / static_cast<float>(kGuidePoints - 1);
  const std::uint64_t seed = random.bits();
  const bool fringe = guide.side == 2 && style.cut == HairCut::kFringe;
  const bool hangs = style.gravity > 0.1F && !fringe;

  Eigen::Vector3f p = root.position;
  Eigen::Vector3f normal = root.normal;
  // Hair stands up on top more than on the sides.
  const float upright =
      0.4F + 0.6F * smooth_step(0.2F, 0.7F, (p.y() - anatomy.skull_centre.y()) / anatomy.skull_radii.y());
  Eigen::Vector3f direction =
      (style.lift * upright * normal + style.flow * flow_at(style, anatomy, p, p, normal) + 0.05F * random.direction())
          .normalized();
  const float volume = style.volume_m * s * upright * static_cast<float>(random.between(0.6, 1.2));
  guide.points.push_back(p);
  guide.normals.push_back(normal);
  // Forces act per centimetre, so that long and short guides of one style bend alike.
  const float share = std::min(1.0F, step / (0.01F * s));
  bool arrived = false;
  bool near = true;  // close enough to the head to be combed along it
  for (int i = 1; i < kGuidePoints; ++i) {
    const float along = static_cast<float>(i) * step;
    if (!arrived) {
      Eigen::Vector3f pull =
          style.flow * flow_at(style, anatomy, root.position, p, near ? normal : Eigen::Vector3f(0, 0, 0));
      pull += style.gravity * Eigen::Vector3f(0, -1, 0) * (fringe ? 1.4F : 1.0F);
      pull += style.wander * noise3(seed, p / (0.035F * s));
      if (hangs) pull += 0.9F * off_the_face(anatomy, p, guide.side);
      direction = (style.stiffness * direction + 1.6F * share * pull).normalized();
      p += step * direction;
      Eigen::Vector3f gradient;
      const float d = field.distance(p, &gradient);
      near = d < field.band() * 0.98F;
      const float layer = volume * smooth_step(0.0F, 0.03F * s, along) + 0.03F * std::min(along, 0.1F * s);
      if (near && gradient.norm() > 1e-3F) {
        normal = gradient.normalized();
        if (d < layer + 0.001F * s) {
          p += normal * (layer + 0.001F * s - d);
          const float inward = direction.dot(normal);
          if (inward < 0) direction = (direction - 0.9F * inward * normal).normalized();
        } else {
          p -= normal * std::min(style.lie * share * (d - layer), 0.5F * step);
        }
      }
      const Eigen::Vector3f to_bun = style.bun - p;
      if (style.cut == HairCut::kTied && to_bun.norm() < 0.016F * s) arrived = true;
    }
    guide.points.push_back(p);
    guide.normals.push_back(normal);
  }
  return guide;
}

}  // namespace faceprobe::synth
