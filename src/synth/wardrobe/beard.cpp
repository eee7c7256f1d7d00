#include "synth/wardrobe/beard.h"

#include "synth/wardrobe/hair.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/strand_list.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Share of the places on the skin that bear hair: 0 .. 1 each.
struct Growth {
  float beard = 0;
  float moustache = 0;
};

struct BeardShape {
  float cheek_line;  // how high on the cheeks: 0 low .. 1
  float goatee;      // 1 = chin only
  float length_m;
  float moustache_m;
};

// The lips as an ellipse about the mouth, widened by `margin`.
bool on_lips(const Anatomy& a, const Eigen::Vector3f& p, float margin) {
  const Eigen::Vector3f middle = 0.5F * (a.landmark(48) + a.landmark(54));
  const float half_width = 0.5F * (a.landmark(54) - a.landmark(48)).norm() + margin;
  const float x = (p.x() - middle.x()) / half_width;
  if (std::abs(x) >= 1) return false;
  const float arch = std::sqrt(1.0F - x * x);
  const float up = (std::max(a.landmark(50).y(), a.landmark(52).y()) - middle.y()) * arch + margin;
  const float down = (middle.y() - a.landmark(57).y()) * arch + margin;
  return p.y() < middle.y() + up && p.y() > middle.y() - down;
}

Growth growth_at(const Anatomy& a, const BeardShape& shape, const Eigen::Vector3f& p) {
  const float s = a.scale;
  Growth growth;
  if (p.z() < a.ear_front + 0.004F * s || on_lips(a, p, 0.0015F * s)) return growth;
  const float nose = a.landmark(33).y();
  const Eigen::Vector3f corner = p.x() > 0 ? a.landmark(54) : a.landmark(48);
  const float mouth_half = std::abs(corner.x());
  const float across = std::abs(p.x());
  // Upper lip: between nose and mouth, falling off beside the corners.
  const float lip_top = nose - 0.004F * s - 0.006F * s * smooth_step(0.2F, 1.2F, across / mouth_half);
  if (p.y() < lip_top + 0.003F * s && p.y() > corner.y() - 0.004F * s) {
    growth.moustache =
        smooth_step(lip_top + 0.003F * s, lip_top - 0.004F * s, p.y()) * smooth_step(1.3F, 1.0F, across / mouth_half);
  }
  // Cheeks: under a line from the sideburns to the moustache's end.
  const float out = smooth_step(mouth_half, 0.072F * s, across);
  const float line =
      corner.y() + (0.002F + 0.010F * shape.cheek_line) * s + out * out * (a.ear_top - 0.022F * s - corner.y());
  const float chin = a.landmark(8).y();
  float cheek = smooth_step(line + 0.003F * s, line - 0.006F * s, p.y());
  // Neck: down to a finger over the larynx.
  const float back = smooth_step(a.landmark(8).z() - 0.01F * s, a.ear_front, p.z());
  const float neck_line = chin - 0.028F * s + 0.055F * s * back * back;
  cheek *= smooth_step(neck_line - 0.004F * s, neck_line + 0.008F * s, p.y());
  // The bare spots beside the lower lip.
  const Eigen::Vector3f below = 0.5F * (a.landmark(57) + a.landmark(8));
  const float spot = std::hypot((across - 0.6F * mouth_half) / (0.008F * s),
                                (p.y() - (a.landmark(57).y() - 0.004F * s)) / (0.006F * s));
  cheek *= smooth_step(0.5F, 1.3F, spot);
  const float far_from_chin =
      std::hypot(across / (mouth_half * 1.15F), std::max(0.0F, p.y() - corner.y()) / (0.01F * s));
  if (p.y() > below.y() + 0.03F * s && across < mouth_half * 0.7F) cheek = 0;
  growth.beard = cheek * (1.0F - shape.goatee * smooth_step(0.85F, 1.15F, far_from_chin));
  return growth;
}

}  // namespace

void add_beard(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Figure& out) {
  if (settings.beard <= 0 && settings.moustache <= 0) return;
  Random random({settings.seed, 0xbea2d});
  const float s = a.scale;
  BeardShape shape{};
  shape.cheek_line = static_cast<float>(random.between(-0.5, 1.0));
  shape.goatee = random.chance(0.2) ? 1.0F : 0.0F;
  shape.length_m = (0.003F + 0.022F * settings.beard * settings.beard) * s;
  shape.moustache_m = (0.004F + 0.008F * settings.moustache) * s;
  const auto colour_shift = static_cast<float>(random.between(0.7, 1.2));

  // Triangles that may bear hair, with their areas.
  const SurfaceMesh& skin = a.skin;
  std::vector<int> triangles;
  std::vector<float> up_to;
  float area = 0;
  const float nose = a.landmark(33).y();
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const auto c = skin.triangles.row(t);
    const Eigen::Vector3f p = skin.vertices.row(c(0)).transpose();
    if (p.y() > a.ear_top || p.z() < a.ear_front - 0.01F * s || p.y() < a.landmark(8).y() - 0.05F * s) continue;
    const Eigen::Vector3f q = skin.vertices.row(c(1)).transpose();
    const Eigen::Vector3f r = skin.vertices.row(c(2)).transpose();
    const Growth growth = growth_at(a, shape, (p + q + r) / 3.0F);
    if (growth.beard <= 0 && growth.moustache <= 0) continue;
    area += 0.5F * (q - p).cross(r - p).norm();
    triangles.push_back(t);
    up_to.push_back(area);
  }
  if (triangles.empty()) return;

  Reflectance reflectance = hair_reflectance(colour_shift * settings.hair_colour);
  StrandList strands(reflectance, Region::kHair);
  std::vector<Eigen::Vector3f> points(5);
  const Eigen::Vector3f mouth = 0.5F * (a.landmark(48) + a.landmark(54));
  const int tries = static_cast<int>(static_cast<float>(settings.strands) * 0.75F);
  for (int i = 0; i < tries; ++i) {
    const auto at = static_cast<float>(random.uniform()) * area;
    const auto pick = std::min<std::ptrdiff_t>(std::ranges::upper_bound(up_to, at) - up_to.begin(),
                                               static_cast<std::ptrdiff_t>(triangles.size()) - 1);
    const auto c = skin.triangles.row(triangles[static_cast<std::size_t>(pick)]);
    const float r = std::sqrt(static_cast<float>(random.uniform()));
    const float v = static_cast<float>(random.uniform()) * r;
    const float u = r - v;
    const Eigen::Vector3f root =
        ((1.0F - u - v) * skin.vertices.row(c(0)) + u * skin.vertices.row(c(1)) + v * skin.vertices.row(c(2))).transpose();
    const Eigen::Vector3f n =
        ((1.0F - u - v) * skin.normals.row(c(0)) + u * skin.normals.row(c(1)) + v * skin.normals.row(c(2))).transpose();
    const auto dice = static_cast<float>(random.uniform());
    const Eigen::Vector3f wild = random.direction();
    const auto length_dice = static_cast<float>(random.between(0.6, 1.15));
    const auto tone_dice = static_cast<float>(random.normal());
    if (n.norm() < 1e-3F) continue;
    const Eigen::Vector3f normal = n.normalized();
    const Growth growth = growth_at(a, shape, root);
    const float patchy = 0.75F + 0.35F * noise(settings.seed, root / (0.008F * s));
    const bool lip = growth.moustache > growth.beard;
    const float wanted = (lip ? growth.moustache * smooth_step(0.0F, 0.5F, settings.moustache)
                              : growth.beard * smooth_step(0.0F, 0.5F, settings.beard)) *
                         patchy;
    if (wanted <= dice) continue;
    Eigen::Vector3f comb(0, -1, 0.1F);
    if (lip) comb = {0.9F * std::copysign(1.0F, root.x()), -0.75F, 0};
    if (!lip && root.y() < nose) comb.x() += 4.0F * (mouth.x() - root.x());
    comb = (comb - normal * normal.dot(comb)).normalized();
    float length = (lip ? shape.moustache_m : shape.length_m) * length_dice * (0.5F + 0.5F * std::min(1.0F, wanted));
    // Longest on the chin, short towards the ears.
    if (!lip) length *= 0.45F + 0.75F * smooth_step(0.07F * s, 0.02F * s, std::abs(root.x()));
    if (lip) length = std::min(length, 0.9F * std::max(0.003F * s, root.y() - mouth.y()) + 0.004F * s);
    Eigen::Vector3f direction = (0.8F * normal + 0.8F * comb + 0.35F * wild).normalized();
    points[0] = root - 0.0004F * s * normal;
    for (std::size_t k = 1; k < points.size(); ++k) {
      points[k] = points[k - 1] + direction * (length / 4.0F);
      direction = (direction + 0.35F * comb + Eigen::Vector3f(0, -0.12F, 0) +
                   0.15F * noise3(settings.seed + 5, points[k] / (0.006F * s)))
                      .normalized();
      field.push_out(points[k], 0.0005F * s);
    }
    strands.add(points, 0.00026F * s, 0.4F, std::exp(0.18F * tone_dice));
  }
  if (!strands.empty()) out.strands.push_back(strands.take());
}

void add_lashes(const WardrobeSettings& settings, const Anatomy& a, Figure& out) {
  Random random({settings.seed, 0x1a54});
  const float s = a.scale;
  const auto length = static_cast<float>(random.between(0.005, 0.0085)) * s;
  StrandList strands(hair_reflectance((0.6F * settings.hair_colour).cwiseMin(0.03F)), Region::kEyelids);
  std::vector<Eigen::Vector3f> points(5);
  for (const int first : {36, 42}) {
    const bool left = first == 42;
    // The upper lid from the outer corner to the inner one.
    const std::array<Eigen::Vector3f, 4> lid =
        left ? std::array<Eigen::Vector3f, 4>{a.landmark(45), a.landmark(44), a.landmark(43), a.landmark(42)}
             : std::array<Eigen::Vector3f, 4>{a.landmark(36), a.landmark(37), a.landmark(38), a.landmark(39)};
    const float out_x = left ? 1.0F : -1.0F;
    constexpr int kLashes = 46;
    for (int i = 0; i < kLashes; ++i) {
      const float t = (static_cast<float>(i) + static_cast<float>(random.uniform())) / kLashes * 0.9F;
      const float at = 3.0F * t;
      const auto k = std::min<std::size_t>(static_cast<std::size_t>(at), 2);
      const float f = at - static_cast<float>(k);
      // Quadratic rise between the landmarks: the lid is rounder than its four points.
      const Eigen::Vector3f root =
          lid[k] + f * (lid[k + 1] - lid[k]) + Eigen::Vector3f(0, 0.0008F, 0.0006F) * s * 4.0F * f * (1.0F - f);
      const float outer = 1.0F - t;
      const Eigen::Vector3f start = Eigen::Vector3f(out_x * (0.75F * outer - 0.2F), -0.25F, 1.0F).normalized();
      const Eigen::Vector3f bend(0, 0.5F, -0.12F);
      const float own = length * (0.55F + 0.45F * outer) * static_cast<float>(random.between(0.75, 1.1));
      points[0] = root;
      Eigen::Vector3f direction = start + 0.1F * random.direction();
      for (std::size_t p = 1; p < points.size(); ++p) {
        points[p] = points[p - 1] + direction.normalized() * (own / 4.0F);
        direction += bend;
      }
      strands.add(points, 0.00011F * s, 0.3F, 1.0F);
    }
  }
  out.strands.push_back(strands.take());
}

}  // namespace faceprobe::synth
