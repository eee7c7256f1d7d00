#include "synth/wardrobe/hair.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/strand_list.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

enum Purpose : std::uint64_t { kStyle = 11, kRoots, kGuides, kChildren };

constexpr int kGuideCount = 300;
constexpr int kNear = 3;  // guides that a strand follows

struct Follow {
  std::array<int, kNear> guide{};
  std::array<float, kNear> weight{};
};

Follow nearest_guides(const std::vector<Guide>& guides, const Eigen::Vector3f& root, int side) {
  Follow follow;
  std::array<float, kNear> best;
  best.fill(1e9F);
  for (int g = 0; g < static_cast<int>(guides.size()); ++g) {
    const Guide& guide = guides[static_cast<std::size_t>(g)];
    float squared = (guide.root - root).squaredNorm();
    if (guide.side != side) squared += 1.0F;  // only if there is no other
    if (squared >= best[kNear - 1]) continue;
    int k = kNear - 1;
    for (; k > 0 && best[static_cast<std::size_t>(k - 1)] > squared; --k) {
      best[static_cast<std::size_t>(k)] = best[static_cast<std::size_t>(k - 1)];
      follow.guide[static_cast<std::size_t>(k)] = follow.guide[static_cast<std::size_t>(k - 1)];
    }
    best[static_cast<std::size_t>(k)] = squared;
    follow.guide[static_cast<std::size_t>(k)] = g;
  }
  float sum = 0;
  for (std::size_t k = 0; k < kNear; ++k) {
    follow.weight[k] = best[k] < 1e8F ? 1.0F / (best[k] + 2e-5F) : 0.0F;
    if (best[k] > best[0] + 0.5F) follow.weight[k] = 0;
    sum += follow.weight[k];
  }
  for (float& w : follow.weight) w /= sum;
  return follow;
}

// One strand's own ways, drawn before its shape so that the order of drawing is plain to see.
struct Ways {
  float length;  // share of its guides'
  float layer;   // metres above (below) them
  float phase;
  float frizz;
  Eigen::Vector3f frizz_phase;
  Eigen::Vector3f astray;
  float tone;
};

Ways draw_ways(const HairStyle& style, Random& random) {
  Ways ways;
  ways.length = std::clamp(1.0F - style.length_jitter * static_cast<float>(std::abs(random.normal())), 0.3F, 1.0F);
  ways.layer = style.volume_m * static_cast<float>(random.between(-0.5, 0.6));
  ways.phase = static_cast<float>(random.between(0, 2 * kPi));
  const bool stray = random.chance(style.flyaway);
  ways.frizz = style.frizz_m * (stray ? 2.5F : 1.0F);
  for (int k = 0; k < 3; ++k) ways.frizz_phase(k) = static_cast<float>(random.between(0, 2 * kPi));
  ways.astray = stray ? Eigen::Vector3f(random.direction() * static_cast<float>(random.between(0.1, 0.35)))
                      : Eigen::Vector3f(0, 0, 0);
  ways.tone = std::exp(0.16F * static_cast<float>(random.normal()));
  return ways;
}

class HeadOfHair {
 public:
  HeadOfHair(const HairStyle& style, const Anatomy& anatomy, const SkinField& field, const std::vector<Guide>& guides)
      : style_(style), anatomy_(anatomy), field_(field), guides_(guides) {}

  // Points of a strand without its clump.
  void shape(const Scalp::Root& root, const Ways& ways, std::vector<Eigen::Vector3f>& points) const {
    const float s = anatomy_.scale;
    const Follow follow = nearest_guides(guides_, root.position, side_of(style_, anatomy_, root.position));
    const int n = style_.points;
    points.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const float at = ways.length * static_cast<float>(i) / static_cast<float>(n - 1) * (kGuidePoints - 1);
      const auto k = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kGuidePoints - 2));
      const float t = at - static_cast<float>(k);
      Eigen::Vector3f p(0, 0, 0);
      Eigen::Vector3f normal(0, 0, 0);
      for (std::size_t j = 0; j < kNear; ++j) {
        if (follow.weight[j] <= 0) continue;
        const Guide& guide = guides_[static_cast<std::size_t>(follow.guide[j])];
        p += follow.weight[j] *
             (guide.points[k] + t * (guide.points[k + 1] - guide.points[k]) + root.position - guide.root);
        normal += follow.weight[j] * guide.normals[k];
      }
      const float up = static_cast<float>(i) / static_cast<float>(n - 1);
      const float free = std::min(1.0F, 2.5F * up);
      p += normal * ways.layer * s * free;
      p += std::min(style_.top_m, 0.05F) * s * up * up * ways.astray;
      for (int c = 0; c < 3; ++c)
        p(c) += ways.frizz * s * free * std::sin(ways.frizz_phase(c) + 9.0F * up * static_cast<float>(c + 1));
      points[static_cast<std::size_t>(i)] = p;
    }
  }

  // Curls and waves, about the strand's own axis; strands of a clump share the phase.
  void curl(float phase, std::vector<Eigen::Vector3f>& points) const {
    if (style_.wave_m <= 0) return;
    const float s = anatomy_.scale;
    float along = 0;
    Eigen::Vector3f side(1, 0, 0);
    Eigen::Vector3f before = points[0];
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Eigen::Vector3f here = points[i];
      const Eigen::Vector3f axis = here - before;
      const float length = axis.norm();
      before = here;
      if (length < 1e-6F) continue;
      along += length;
      const Eigen::Vector3f t = axis / length;
      side -= t * t.dot(side);
      side = side.norm() > 1e-3F ? Eigen::Vector3f(side.normalized()) : t.unitOrthogonal();
      const float angle = phase + 2.0F * static_cast<float>(kPi) * along / (style_.wave_length_m * s);
      const float amplitude = style_.wave_m * s * smooth_step(0.0F, 0.6F * style_.wave_length_m * s, along);
      points[i] += amplitude * std::sin(angle) * side;
      if (style_.helix) points[i] += amplitude * std::cos(angle) * t.cross(side);
    }
  }

  void keep_out(std::vector<Eigen::Vector3f>& points) const {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const float clearance = std::min(0.0012F, 0.0006F * static_cast<float>(i)) * anatomy_.scale;
      field_.push_out(points[i], clearance);
      if (field_.distance(points[i]) >= 0) continue;
      // Too deep for the field to know the way out: the strand stays near where it was still outside.
      const Eigen::Vector3f step = points[i] - points[i - 1];
      points[i] = points[i - 1] + std::min(1.0F, 0.002F * anatomy_.scale / std::max(1e-6F, step.norm())) * step;
      field_.push_out(points[i], clearance);
    }
  }

 private:
  const HairStyle& style_;
  const Anatomy& anatomy_;
  const SkinField& field_;
  const std::vector<Guide>& guides_;
};

struct Clump {
  Eigen::Vector3f root;
  int side;
  float phase;
  float tone;
  std::vector<Eigen::Vector3f> points;
};

int nearest_clump(const std::vector<Clump>& clumps, const Eigen::Vector3f& root, int side) {
  int best = 0;
  float nearest = 1e9F;
  for (int i = 0; i < static_cast<int>(clumps.size()); ++i) {
    const Clump& clump = clumps[static_cast<std::size_t>(i)];
    const float squared = (clump.root - root).squaredNorm() + (clump.side != side ? 1.0F : 0.0F);
    if (squared < nearest) {
      nearest = squared;
      best = i;
    }
  }
  return best;
}

}  // namespace

Reflectance hair_reflectance(const Eigen::Vector3f& colour) {
  Reflectance reflectance;
  // Kajiya and Kay's diffuse term has no light that went from strand to strand, about half of what fair hair sends back.
  reflectance.albedo = (2.0F * colour).cwiseMin(0.95F);
  reflectance.roughness = 0.3F;
  reflectance.specular_albedo = 0.35F;
  reflectance.f0 = 0.046F;  // keratin, n = 1.55
  return reflectance;
}

void add_hair(const WardrobeSettings& settings, const Anatomy& anatomy, const SkinField& field, const HatShell& hat,
              Figure& out) {
  if (settings.headwear == Headwear::kScarf) return;
  if (settings.cut == HairCut::kBald || settings.strands <= 0) return;
  const Random root_random({settings.seed, 0x4a12});
  Random style_random = root_random.split(kStyle);
  const HairStyle style = draw_style(settings, anatomy, style_random);
  const Scalp scalp(anatomy, style.hairline, settings.seed);
  const float s = anatomy.scale;

  Random roots_random = root_random.split(kRoots);
  std::vector<Guide> guides;
  Random guide_random = root_random.split(kGuides);
  for (const Scalp::Root& root : scalp.roots(kGuideCount, 0.002F * s, roots_random)) {
    guides.push_back(grow(style, anatomy, field, root, guide_random));
  }
  if (guides.empty()) return;

  Random random = root_random.split(kChildren);
  const HeadOfHair hair(style, anatomy, field, guides);
  const int count = std::max(1, static_cast<int>(static_cast<float>(settings.strands) * style.strand_share));
  const std::vector<Scalp::Root> roots = scalp.roots(count, style.feather_m * s, roots_random);

  std::vector<Clump> clumps;
  if (style.clump > 0) {
    for (std::size_t i = 0; i < roots.size(); i += static_cast<std::size_t>(style.clump_size)) {
      Clump clump{roots[i].position, side_of(style, anatomy, roots[i].position), 0, 0, {}};
      const Ways ways = draw_ways(style, random);
      // Neighbouring clumps wave together, mostly.
      clump.phase = 0.35F * ways.phase + 6.0F * noise(settings.seed + 3, clump.root / (0.05F * s));
      clump.tone = std::exp(0.10F * static_cast<float>(random.normal()));
      hair.shape(roots[i], ways, clump.points);
      clumps.push_back(clump);
    }
  }

  StrandList strands(hair_reflectance(settings.hair_colour), Region::kHair);
  std::vector<Eigen::Vector3f> points;
  for (const Scalp::Root& root : roots) {
    const Ways ways = draw_ways(style, random);
    hair.shape(root, ways, points);
    float tone = ways.tone;
    float phase = ways.phase;
    if (!clumps.empty()) {
      const int side = side_of(style, anatomy, root.position);
      const Clump& clump = clumps[static_cast<std::size_t>(nearest_clump(clumps, root.position, side))];
      tone *= clump.tone;
      phase = clump.phase + 0.25F * (ways.phase - static_cast<float>(kPi));
      const float pull = clump.side == side && ways.astray.isZero() ? style.clump : 0.0F;
      for (std::size_t i = 1; i < points.size(); ++i) {
        const float up = static_cast<float>(i) / static_cast<float>(points.size() - 1);
        points[i] += pull * up * (clump.points[i] - points[i]);
      }
    }
    hair.curl(phase, points);
    points[0] = root.position - 0.0004F * s * root.normal;
    hair.keep_out(points);
    if (!hat.empty()) {
      // What the hat covers is not seen; what sticks out below is pressed flat at its rim.
      std::size_t covered = 0;
      for (Eigen::Vector3f& p : points) covered += hat.press(p, 0.004F * s) ? 1 : 0;
      if (covered == points.size()) continue;
    }
    const float thin = 0.75F + 0.25F * smooth_step(0, style.feather_m * s, root.inside);
    strands.add(points, style.radius_m * s * thin, 0.4F, tone);
  }
  if (!strands.empty()) out.strands.push_back(strands.take());

  // Under the strands no skin shows. A close crop lets some of it through.
  SurfaceMesh cap = scalp.cap((style.cut == HairCut::kBuzz ? 0.007F : 0.006F) * s, 0.0007F * s);
  cap.reflectance.albedo = 0.5F * settings.hair_colour;
  if (style.cut == HairCut::kBuzz) cap.reflectance.albedo = 0.5F * settings.hair_colour + 0.25F * settings.skin_tone;
  cap.reflectance.roughness = 0.6F;
  cap.reflectance.specular_albedo = 0.05F;
  if (cap.triangles.rows() > 0) out.meshes.push_back(std::move(cap));
}

}  // namespace faceprobe::synth
