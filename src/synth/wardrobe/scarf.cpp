#include "faceprobe/core/angles.h"
#include "synth/wardrobe/cloth.h"
#include "synth/wardrobe/headwear.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/shapes.h"
#include "synth/wardrobe/torso.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Directions about the axis out of the face: `around` from up towards +x, `away` from the axis.
struct Polar {
  float around, away;
};

Polar polar_of(const Eigen::Vector3f& q) {
  float around = std::atan2(q.x(), q.y());
  if (around < 0) around += kTurn;
  return {around, std::atan2(std::hypot(q.x(), q.y()), q.z())};
}

// The opening for the face, from the middle of the forehead round: (around, away), ascending.
std::vector<Polar> face_opening(const Anatomy& a, const Eigen::Vector3f& centre, float forehead_m) {
  const float s = a.scale;
  const float brow = a.brow_y();
  const float front = a.skull_centre.z() + a.skull_radii.z();
  std::vector<Eigen::Vector3f> half = {{0, brow + forehead_m, front - 0.010F * s},
                                       {0.030F * s, brow + 0.95F * forehead_m, front - 0.018F * s},
                                       {0.054F * s, brow + 0.5F * forehead_m, front - 0.045F * s}};
  for (const int i : {16, 14, 12, 10, 9}) half.emplace_back(a.landmark(i) + Eigen::Vector3f(0, -0.002F, 0.004F) * s);
  half.emplace_back(a.landmark(8) + Eigen::Vector3f(0, -0.003F, -0.004F) * s);
  std::vector<Polar> knots;
  knots.reserve(half.size());
  for (const Eigen::Vector3f& p : half) knots.push_back(polar_of(p - centre));
  knots.front().around = 0;
  knots.back().around = kTurn / 2;
  for (std::size_t i = 1; i < knots.size(); ++i)
    knots[i].around = std::max(knots[i].around, knots[i - 1].around + 0.01F);
  return knots;
}

float away_at(const std::vector<Polar>& knots, float around) {
  const float folded = around <= kTurn / 2 ? around : kTurn - around;  // the same on both sides
  std::size_t i = 1;
  while (i + 1 < knots.size() && knots[i].around < folded) ++i;
  const float t = std::clamp((folded - knots[i - 1].around) / (knots[i].around - knots[i - 1].around), 0.0F, 1.0F);
  return knots[i - 1].away + t * (knots[i].away - knots[i - 1].away);
}

}  // namespace

void add_scarf(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Figure& out) {
  if (settings.headwear != Headwear::kScarf) return;
  Random random({settings.seed, 0x5ca2f});
  const float s = a.scale;
  const Cloth cloth = draw_cloth(random, true);
  const Eigen::Vector3f centre(a.skull_centre.x(), -0.025F * s, a.skull_centre.z() - 0.005F * s);
  const std::vector<Polar> opening = face_opening(a, centre, static_cast<float>(random.between(0.030, 0.046)) * s);

  // Over the head, from the opening to the back.
  constexpr int kAround = 96;
  constexpr int kRows = 40;
  std::vector<float> radius(kAround * kRows);
  const auto direction = [&](int r, int i) -> Eigen::Vector3f {
    const float around = kTurn * static_cast<float>(i) / kAround;
    const float from = away_at(opening, around);
    const float away = from + (kTurn / 2 - 0.01F - from) * static_cast<float>(r) / (kRows - 1);
    return {std::sin(away) * std::sin(around), std::sin(away) * std::cos(around), std::cos(away)};
  };
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kAround; ++i) {
      const Eigen::Vector3f d = direction(r, i);
      float reach = 0.2F * s;
      // Below the jaw it stays near the neck: the drape below covers the rest.
      if (d.y() < 0) reach = std::min(reach, s / d.cwiseQuotient(Eigen::Vector3f(0.098F, 0.118F, 0.125F)).norm());
      while (reach > 0.04F * s) {
        const float gap = field.distance(centre + reach * d);
        if (gap < 0.001F) break;
        reach -= std::max(0.6F * gap, 0.001F);
      }
      radius[static_cast<std::size_t>(r * kAround + i)] = reach;
    }
  }
  // Cloth spans hollows, apart from its edge around the face.
  for (int pass = 0; pass < 24; ++pass) {
    for (int r = 1; r + 1 < kRows; ++r) {
      float* row = radius.data() + static_cast<std::ptrdiff_t>(r) * kAround;
      for (int i = 0; i < kAround; ++i) {
        const float beside = 0.5F * (row[(i + 1) % kAround] + row[(i + kAround - 1) % kAround]);
        const float along = 0.5F * (row[i - kAround] + row[i + kAround]);
        row[i] = std::max(row[i], std::max(beside, along) - 0.0004F * s);
      }
    }
  }
  MeshBuilder mesh;
  std::vector<Eigen::Vector3f> points;
  for (int r = 0; r < kRows; ++r) {
    const float t = static_cast<float>(r) / (kRows - 1);
    for (int i = 0; i < kAround; ++i) {
      const Eigen::Vector3f d = direction(r, i);
      float room = (0.004F + 0.006F * smooth_step(0.0F, 0.06F, t)) * s;
      // Folds run from the chin over the crown.
      room += 0.0028F * s * smooth_step(0.02F, 0.15F, t) *
              noise(cloth.seed + 4, Eigen::Vector3f(5.0F * d.x(), 2.5F * d.y(), 9.0F * d.z() + 4.0F * std::abs(d.x())));
      if (r == 0) room = 0.0005F * s;
      points.emplace_back(centre + d * (radius[static_cast<std::size_t>(r * kAround + i)] + room));
    }
  }
  mesh.grid(points, kAround, true);

  // Around the neck, down to the shoulders.
  constexpr int kSteps = 36;
  points.clear();
  for (int r = 0; r < kSteps; ++r) {
    const float t = static_cast<float>(r) / (kSteps - 1);
    for (int i = 0; i < kAround; ++i) {
      const float azimuth = kTurn * static_cast<float>(i) / kAround;
      const float ahead = std::max(0.0F, std::cos(azimuth));
      const float last =
          3.0F + 1.3F * ahead +
          0.5F * noise(cloth.seed + 8, Eigen::Vector3f(3.0F * std::sin(azimuth), 3.0F * std::cos(azimuth), 0));
      const float station = -2.0F + (last + 2.0F) * t;
      // It starts inside the cloth under the jaw and falls in folds.
      float room = (0.004F + 0.012F * smooth_step(0.0F, 0.3F, t) - 0.008F * smooth_step(0.85F, 1.0F, t)) * s;
      room += 0.016F * s * smooth_step(0.05F, 0.3F, t) * smooth_step(0.7F, 0.3F, t) * (0.4F + 0.6F * ahead);
      Eigen::Vector3f p = body_at(a, station, azimuth, 0);
      const float wave = noise(
          cloth.seed + 6, Eigen::Vector3f(p.x(), 1.8F * p.y() + 0.5F * std::abs(p.x()), 0.6F * p.z()) / (0.024F * s));
      room += 0.006F * s * smooth_step(0.15F, 0.4F, t) * smooth_step(1.0F, 0.8F, t) * wave;
      points.push_back(body_at(a, station, azimuth, room));
    }
  }
  mesh.grid(points, kAround, true, true);
  mesh.colour([&](const Eigen::Vector3f& p) { return cloth.at(p); });
  out.meshes.push_back(mesh.take(Material::kCloth, Region::kClothes, {cloth.colour, 0.5F, 0.05F, 0.04F}));
}

}  // namespace faceprobe::synth
