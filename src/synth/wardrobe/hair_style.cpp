#include "synth/wardrobe/hair_style.h"

#include "synth/wardrobe/draw.h"
#include "synth/wardrobe/noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

void short_cut(HairStyle& style, Random& random) {
  style.top_m = draw(random, 0.025, 0.055);
  style.front_m = style.top_m * draw(random, 0.9, 1.3);
  style.side_m = draw(random, 0.008, 0.025);
  style.nape_m = draw(random, 0.006, 0.016);
  const float sweep = draw(random, -0.9, 0.9);
  const double look = random.uniform();
  if (look < 0.55) {
    style.comb = {sweep, 0.0F, 0.8F};  // forward and aside
    style.lift = 0.55F;
  } else if (look < 0.72) {
    style.comb = {1.2F * sweep, 0.4F, 0.3F};  // up and aside
    style.lift = 0.6F;
  } else {
    style.comb = {0.5F * sweep, 0.3F, -0.9F};  // brushed back
    style.lift = 0.8F;
  }
  style.flow = draw(random, 0.35, 0.7);
  style.gravity = 0.06F;
  style.lie = 0.25F;
  style.volume_m = draw(random, 0.004, 0.009);
  style.wander = draw(random, 0.08, 0.25);
  style.clump = draw(random, 0.4, 0.75);
  style.length_jitter = 0.25F;
  style.points = 8;
  style.radius_m = 0.00038F;
}

void waves(HairStyle& style, Random& random, double share) {
  if (!random.chance(share)) return;
  style.wave_m = draw(random, 0.002, 0.007);
  style.wave_length_m = draw(random, 0.04, 0.09);
  style.helix = random.chance(0.5);
  style.points = 14;
}

void long_cut(HairStyle& style, Random& random) {
  style.top_m = draw(random, 0.26, 0.46);
  style.front_m = style.top_m * draw(random, 0.75, 1.0);
  style.side_m = style.top_m * draw(random, 0.8, 0.95);
  style.nape_m = style.top_m * 0.7F;
  if (random.chance(0.25)) {  // a bob
    style.top_m = draw(random, 0.19, 0.24);
    style.front_m = style.top_m * 0.95F;
    style.side_m = style.top_m * 0.72F;
    style.nape_m = 0.07F;
  }
  style.parted = true;
  style.part_x = random.chance(0.5) ? draw(random, -0.006, 0.006)
                                    : draw(random, 0.015, 0.035) * (random.chance(0.5) ? 1.0F : -1.0F);
  style.backward = draw(random, 0.0, 0.6);
  style.stiffness = 0.8F;
  style.flow = 0.45F;
  style.gravity = 0.42F;
  style.lift = 0.45F;
  style.lie = 0.1F;
  style.volume_m = draw(random, 0.008, 0.016);
  style.wander = 0.08F;
  style.clump = draw(random, 0.35, 0.7);
  style.clump_size = 20;
  style.length_jitter = 0.12F;
  style.points = 13;
  style.radius_m = 0.00042F;
  style.strand_share = 0.85F;
  style.hairline.recess_m = 0.0F;
  style.hairline.sideburn_m = 0.012F;
  waves(style, random, 0.5);
}

}  // namespace

HairStyle draw_style(const WardrobeSettings& settings, const Anatomy& anatomy, Random& random) {
  HairStyle style;
  style.cut = settings.cut;
  style.hairline.front_m = draw(random, 0.046, 0.058);
  style.hairline.recess_m = draw(random, -0.002, 0.010);
  style.hairline.sideburn_m = draw(random, 0.012, 0.034);
  style.whorl_side = random.chance(0.5) ? 1.0F : -1.0F;
  switch (settings.cut) {
    case HairCut::kBald: break;
    case HairCut::kBuzz:
      style.top_m = draw(random, 0.003, 0.009);
      style.front_m = style.top_m;
      style.side_m = style.top_m * draw(random, 0.35, 0.9);
      style.nape_m = style.side_m * 0.8F;
      style.flow = 0.8F;
      style.gravity = 0.0F;
      style.volume_m = 0.0F;
      style.lie = 0.0F;
      style.wander = 0.15F;
      style.clump = 0.0F;
      style.frizz_m = 0.0002F;
      style.flyaway = 0.0F;
      style.points = 3;
      style.radius_m = 0.00030F;
      style.strand_share = 1.6F;
      style.feather_m = 0.016F;
      style.hairline.raggedness_m = 0.0016F;
      style.comb = {0.2F * style.whorl_side, 0, 1};
      break;
    case HairCut::kShort: short_cut(style, random); break;
    case HairCut::kParted:
      short_cut(style, random);
      style.parted = true;
      style.part_x = draw(random, 0.022, 0.038) * style.whorl_side;
      style.top_m = draw(random, 0.06, 0.11);
      style.front_m = style.top_m * draw(random, 0.9, 1.1);
      style.side_m = draw(random, 0.015, 0.06);
      style.nape_m = draw(random, 0.01, 0.03);
      style.comb = {0.0F, 0.0F, -0.35F};
      style.flow = 0.7F;
      style.gravity = 0.12F;
      style.lift = 0.9F;
      style.lie = 0.25F;
      style.volume_m = draw(random, 0.007, 0.014);
      style.clump = draw(random, 0.4, 0.7);
      style.points = 10;
      style.hairline.recess_m *= 0.5F;
      break;
    case HairCut::kFringe: {
      if (random.chance(0.6)) {
        long_cut(style, random);
        style.parted = false;
        style.backward = draw(random, 0.0, 0.3);
      } else {
        style.top_m = draw(random, 0.09, 0.13);
        style.side_m = draw(random, 0.05, 0.09);
        style.nape_m = draw(random, 0.03, 0.05);
        style.gravity = 0.3F;
        style.flow = 0.5F;
        style.lie = 0.12F;
        style.volume_m = draw(random, 0.007, 0.012);
        style.points = 11;
        style.radius_m = 0.0004F;
        style.clump = 0.55F;
        waves(style, random, 0.2);
      }
      style.fringe_end_m = draw(random, -0.004, 0.016);
      style.length_jitter = 0.1F;
      style.comb = {draw(random, -0.35, 0.35), 0.0F, 1.0F};
      break;
    }
    case HairCut::kLong: long_cut(style, random); break;
    case HairCut::kCurly: {
      style.top_m = draw(random, 0.05, 0.13);
      style.front_m = style.top_m * draw(random, 0.8, 1.0);
      style.side_m = style.top_m * draw(random, 0.5, 1.0);
      style.nape_m = style.side_m * 0.8F;
      const bool tight = random.chance(0.45);
      style.flow = tight ? 0.05F : 0.2F;
      style.gravity = tight ? 0.02F : 0.16F;
      style.lift = 1.2F;
      style.lie = 0.0F;
      style.volume_m = 0.012F;
      style.wander = 0.35F;
      style.clump = tight ? 0.35F : 0.8F;
      style.clump_size = tight ? 10 : 16;
      style.wave_m = tight ? draw(random, 0.0025, 0.004) : draw(random, 0.004, 0.008);
      style.wave_length_m = tight ? draw(random, 0.014, 0.02) : draw(random, 0.025, 0.045);
      style.helix = true;
      style.frizz_m = tight ? 0.0025F : 0.0015F;
      style.length_jitter = 0.3F;
      style.points = tight ? 20 : 18;
      style.radius_m = 0.0004F;
      style.strand_share = tight ? 0.9F : 0.8F;
      style.comb = {0.4F * style.whorl_side, 0, 0.6F};
      style.flyaway = 0.06F;
      break;
    }
    case HairCut::kTied:
      style.bun =
          anatomy.skull_centre + anatomy.skull_radii.cwiseProduct(Eigen::Vector3f(0, draw(random, 0.1, 0.95), -1.12F));
      if (style.bun.y() > anatomy.skull_centre.y() + 0.7F * anatomy.skull_radii.y()) {
        style.bun.z() = anatomy.skull_centre.z() - 0.75F * anatomy.skull_radii.z();
        style.bun.y() = anatomy.skull_centre.y() + 1.12F * anatomy.skull_radii.y();
      }
      style.flow = 1.2F;
      style.gravity = 0.0F;
      style.stiffness = 0.35F;
      style.lift = 0.15F;
      style.lie = 0.6F;
      style.volume_m = draw(random, 0.003, 0.008);
      style.wander = 0.05F;
      style.clump = draw(random, 0.2, 0.45);
      style.length_jitter = 0.0F;
      style.points = 14;
      style.radius_m = 0.00042F;
      style.flyaway = 0.04F;
      style.hairline.recess_m = 0.002F;
      style.hairline.sideburn_m = 0.010F;
      break;
  }
  return style;
}

float length_at(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root) {
  const float s = anatomy.scale;
  if (style.cut == HairCut::kTied) return 1.15F * (root - style.bun).norm() + 0.012F * s;
  if (side_of(style, anatomy, root) == 2) {  // a fringe ends in one line
    const Eigen::Vector3f end(root.x() * 1.25F, anatomy.brow_y() + style.fringe_end_m * s,
                              anatomy.skull_centre.z() + anatomy.skull_radii.z());
    return 1.12F * (root - end).norm();
  }
  const Eigen::Vector3f q = (root - anatomy.skull_centre).cwiseQuotient(anatomy.skull_radii);
  const float top = smooth_step(0.15F, 0.65F, q.y());
  const float front = smooth_step(0.35F, 0.75F, q.z()) * smooth_step(0.1F, 0.4F, q.y());
  const float nape = smooth_step(0.0F, -0.6F, q.y());
  float length = style.side_m + nape * (style.nape_m - style.side_m);
  length += top * (style.top_m - length);
  length += front * (style.front_m - length);
  return length * s;
}

int side_of(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root) {
  if (style.cut == HairCut::kFringe) {  // the fringe and the rest
    const Eigen::Vector3f q = (root - anatomy.skull_centre).cwiseQuotient(anatomy.skull_radii);
    return q.z() > 0.30F && q.y() > 0.4F && std::abs(q.x()) < 0.62F ? 2 : 0;
  }
  if (!style.parted) return 0;
  return root.x() > style.part_x * anatomy.scale ? 1 : -1;
}

Eigen::Vector3f flow_at(const HairStyle& style, const Anatomy& anatomy, const Eigen::Vector3f& root,
                        const Eigen::Vector3f& p, const Eigen::Vector3f& normal) {
  const auto tangent = [&](const Eigen::Vector3f& v) -> Eigen::Vector3f { return v - normal * normal.dot(v); };
  const Eigen::Vector3f& c = anatomy.skull_centre;
  const Eigen::Vector3f q = (p - c).cwiseQuotient(anatomy.skull_radii);
  const Eigen::Vector3f q_root = (root - c).cwiseQuotient(anatomy.skull_radii);
  if (style.cut == HairCut::kTied) {
    const Eigen::Vector3f to_bun = style.bun - p;
    return tangent(to_bun).normalized() + 0.3F * to_bun.normalized();
  }
  const int side = side_of(style, anatomy, root);
  if (side == 2) {
    return tangent(style.comb + Eigen::Vector3f(1.1F * q_root.x(), 0, 0)).normalized() + Eigen::Vector3f(0, -0.15F, 0);
  }
  if (style.parted || style.cut == HairCut::kFringe) {
    // From the parting to the sides, then down, more or less behind the ears.
    const float down = smooth_step(0.95F, 0.4F, q.y());
    const float lateral = side != 0 ? static_cast<float>(side) : std::clamp(1.6F * q_root.x(), -1.0F, 1.0F);
    Eigen::Vector3f comb(lateral * (1.0F - down), 0.0F, -0.25F);
    comb += down * Eigen::Vector3f(0.12F * lateral, -1.0F, -style.backward);
    if (q_root.z() < -0.4F) comb += Eigen::Vector3f(0, -0.6F, -0.4F);  // the back falls back
    comb += style.comb.z() < 0 ? style.comb : Eigen::Vector3f(0, 0, 0);
    return tangent(comb).normalized();
  }
  // Away from the whorl, turning about it; on the front half of the top where it is combed to.
  const Eigen::Vector3f whorl =
      c + anatomy.skull_radii.cwiseProduct(Eigen::Vector3f(0.15F * style.whorl_side, 0.72F, -0.62F));
  Eigen::Vector3f away = tangent(p - whorl).normalized();
  away += 0.45F * style.whorl_side * normal.cross(away);
  const float top = smooth_step(0.45F, 0.8F, q_root.y()) * smooth_step(-0.5F, 0.2F, q_root.z());
  const float front = std::max(top, smooth_step(0.4F, 0.7F, q_root.z()) * smooth_step(0.3F, 0.5F, q_root.y()));
  Eigen::Vector3f comb = style.comb;
  comb -= normal * std::min(0.0F, normal.dot(comb));
  const Eigen::Vector3f down = tangent(Eigen::Vector3f(0, -1, -0.35F));
  const float side_share = smooth_step(0.6F, 0.25F, q_root.y());
  return (1.0F - front) * ((1.0F - side_share) * away + side_share * down) + front * comb.normalized();
}

}  // namespace faceprobe::synth
