#include "synth/wardrobe/headwear.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/cloth.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr float kLowest = -0.9F;  // elevation of the table's first row
constexpr float kHighest = 1.55F;

// From far outside inwards until the skin is reached.
float distance_to_skin(const SkinField& field, const Eigen::Vector3f& centre, const Eigen::Vector3f& direction,
                       float from) {
  float r = from;
  while (r > 0.2F * from) {
    const float d = field.distance(centre + r * direction);
    if (d < 0.0007F) break;
    r -= std::max(0.6F * d, 0.0005F);
  }
  return r;
}

}  // namespace

HatShell::HatShell(const Anatomy& a, const SkinField& field, const Rim& rim) : centre_(a.skull_centre) {
  radius_.resize(static_cast<std::size_t>(kAzimuths * kElevations));
  for (int e = 0; e < kElevations; ++e) {
    const float elevation = kLowest + (kHighest - kLowest) * static_cast<float>(e) / (kElevations - 1);
    for (int i = 0; i < kAzimuths; ++i) {
      const float azimuth = kTurn * static_cast<float>(i) / kAzimuths;
      radius_[static_cast<std::size_t>(e * kAzimuths + i)] =
          distance_to_skin(field, centre_, direction(azimuth, elevation), 0.2F * a.scale);
    }
    // The pole is one point, whichever way it is reached.
    float* row = radius_.data() + static_cast<std::ptrdiff_t>(e) * kAzimuths;
    float mean = 0;
    for (int i = 0; i < kAzimuths; ++i) mean += row[i] / kAzimuths;
    const float even = smooth_step(1.2F, 1.5F, elevation);
    for (int i = 0; i < kAzimuths; ++i) row[i] += even * (mean - row[i]);
    // Cloth spans hollows: in front of and behind the ears.
    for (int pass = 0; pass < 30; ++pass) {
      for (int i = 0; i < kAzimuths; ++i) {
        row[i] = std::max(row[i],
                          0.5F * (row[(i + 1) % kAzimuths] + row[(i + kAzimuths - 1) % kAzimuths]) - 0.0002F * a.scale);
      }
    }
  }
  for (int i = 0; i < kAzimuths; ++i) {
    const float azimuth = kTurn * static_cast<float>(i) / kAzimuths;
    const float c = std::cos(azimuth);
    const float n = std::sin(azimuth);
    const float y = n * n * rim.side + c * c * (c > 0 ? rim.front : rim.back);
    const float out = std::hypot(n * a.skull_radii.x(), c * a.skull_radii.z());
    rim_[static_cast<std::size_t>(i)] = std::atan2(y - centre_.y(), out);
  }
}

float HatShell::rim_elevation(float azimuth) const {
  float at = azimuth / kTurn;
  at = (at - std::floor(at)) * kAzimuths;
  const int i = std::min(static_cast<int>(at), kAzimuths - 1);
  const float t = at - static_cast<float>(i);
  return (1 - t) * rim_[static_cast<std::size_t>(i)] + t * rim_[static_cast<std::size_t>((i + 1) % kAzimuths)];
}

Eigen::Vector3f HatShell::direction(float azimuth, float elevation) const {
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

float HatShell::skin_radius(float azimuth, float elevation) const {
  float at = azimuth / kTurn;
  at = (at - std::floor(at)) * kAzimuths;
  const int i = std::min(static_cast<int>(at), kAzimuths - 1);
  const float t = at - static_cast<float>(i);
  const float row = std::clamp((elevation - kLowest) / (kHighest - kLowest), 0.0F, 0.9999F) * (kElevations - 1);
  const int e = std::min(static_cast<int>(row), kElevations - 2);
  const float u = row - static_cast<float>(e);
  const auto value = [&](int y, int x) { return radius_[static_cast<std::size_t>(y * kAzimuths + x % kAzimuths)]; };
  return (1 - u) * ((1 - t) * value(e, i) + t * value(e, i + 1)) +
         u * ((1 - t) * value(e + 1, i) + t * value(e + 1, i + 1));
}

bool HatShell::press(Eigen::Vector3f& p, float slack_m) const {
  if (empty()) return false;
  const Eigen::Vector3f q = p - centre_;
  const float r = q.norm();
  if (r < 1e-6F) return true;
  const float azimuth = std::atan2(q.x(), q.z());
  const float elevation = std::asin(std::clamp(q.y() / r, -1.0F, 1.0F));
  if (elevation < rim_elevation(azimuth)) return false;
  const float limit = skin_radius(azimuth, elevation) + slack_m;
  if (r > limit) p = centre_ + q * (limit / r);
  return true;
}

namespace {

void beanie(const Anatomy& a, const HatShell& shell, Random& random, MeshBuilder& mesh) {
  const float s = a.scale;
  const Cloth cloth = draw_cloth(random, true);
  const auto slouch = static_cast<float>(random.between(0.0, 0.035)) * s;
  const auto cuff = static_cast<float>(random.between(0.2, 0.42));
  constexpr int kAround = 150;
  constexpr int kRows = 34;
  std::vector<Eigen::Vector3f> points;
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kAround; ++i) {
      const float azimuth = kTurn * static_cast<float>(i) / kAround;
      const float rim = shell.rim_elevation(azimuth);
      const float t = std::max(0.0F, static_cast<float>(r - 2) / (kRows - 3));
      const float elevation = rim + (1.565F - rim) * t;
      float room = 0.007F * s;
      room += 0.004F * s * smooth_step(0.0F, 0.03F, t) * smooth_step(cuff + 0.02F, cuff - 0.02F, t);  // folded over
      room += slouch * smooth_step(0.3F, 0.8F, t) * (0.6F - 0.4F * std::cos(azimuth) * (1.0F - t));
      if (r < 2) room = (r == 0 ? 0.001F : 0.005F) * s;
      room += 0.0015F * s * noise(cloth.seed + 9, shell.direction(azimuth, elevation) * 6.0F);
      if (i % 2 == 0) room -= 0.0007F * s;  // ribs
      points.emplace_back(shell.centre() +
                          shell.direction(azimuth, elevation) * (shell.skin_radius(azimuth, elevation) + room));
    }
  }
  mesh.grid(points, kAround, true);
  mesh.colour([&](const Eigen::Vector3f& p) {
    const Eigen::Vector3f q = p - shell.centre();
    const float rib = std::cos(std::atan2(q.x(), q.z()) * kAround / 2);
    return Eigen::Vector3f(cloth.at(p) * (0.9F - 0.14F * rib));
  });
}

void cap(const Anatomy& a, const HatShell& shell, Random& random, MeshBuilder& mesh) {
  const float s = a.scale;
  const Cloth cloth = draw_cloth(random, false);
  const Eigen::Vector3f brim_colour = random.chance(0.7) ? cloth.colour : draw_dye(random);
  constexpr int kAround = 96;
  constexpr int kRows = 24;
  const auto room_at = [&](float t, float azimuth) {
    const float front = std::max(0.0F, std::cos(azimuth));
    return (0.006F + 0.012F * smooth_step(0.0F, 0.5F, t) * (0.4F + 0.6F * front)) * s;
  };
  const auto surface = [&](float azimuth, float t) -> Eigen::Vector3f {
    const float rim = shell.rim_elevation(azimuth);
    const float elevation = rim + (1.565F - rim) * t;
    return shell.centre() +
           shell.direction(azimuth, elevation) * (shell.skin_radius(azimuth, elevation) + room_at(t, azimuth));
  };
  std::vector<Eigen::Vector3f> points;
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kAround; ++i) {
      const float azimuth = kTurn * static_cast<float>(i) / kAround;
      const float t = std::max(0.0F, static_cast<float>(r - 1) / (kRows - 2));
      Eigen::Vector3f p = surface(azimuth, t);
      if (r == 0) p -= 0.004F * s * (p - shell.centre()).normalized();
      points.push_back(p);
    }
  }
  mesh.grid(points, kAround, true);
  mesh.colour([&](const Eigen::Vector3f& p) {
    const Eigen::Vector3f q = p - shell.centre();
    const float seam = std::abs(std::sin(3.0F * std::atan2(q.x(), q.z())));  // six panels
    return Eigen::Vector3f(cloth.at(p) * (0.75F + 0.25F * smooth_step(0.0F, 0.12F, seam)));
  });
  const int first = mesh.vertex_count();
  const auto length = static_cast<float>(random.between(0.058, 0.072)) * s;
  const auto bend = static_cast<float>(random.between(0.006, 0.022)) * s;
  const auto slope = static_cast<float>(random.between(0.0, 0.22));
  constexpr int kAcross = 40;
  constexpr int kOut = 14;
  const float half = static_cast<float>(radians(62));
  const auto brim = [&](float u, float v, float thick) -> Eigen::Vector3f {
    Eigen::Vector3f p = surface(u * half, 0.015F);
    const float reach = length * std::sqrt(std::max(0.0F, 1.0F - u * u * 0.97F));
    p += Eigen::Vector3f(0.15F * u * reach * v, -slope * reach * v, reach * v);
    p.y() -= bend * u * u * (0.3F + 0.7F * v) + thick;
    return p;
  };
  points.clear();
  // Out along the top, back along the bottom.
  for (int r = 0; r <= 2 * kOut + 1; ++r) {
    const bool top = r <= kOut;
    const float v = static_cast<float>(top ? r : 2 * kOut + 1 - r) / kOut;
    for (int c = 0; c < kAcross; ++c) {
      const float u = 1.0F - 2.0F * static_cast<float>(c) / (kAcross - 1);
      points.push_back(brim(u, v, top ? 0.0F : 0.0025F * s));
    }
  }
  mesh.grid(points, kAcross, false);
  Cloth peak = cloth;
  peak.colour = brim_colour;
  mesh.colour([&](const Eigen::Vector3f& p) { return peak.at(p); }, first);
}

}  // namespace

HatShell add_hat(const WardrobeSettings& settings, const Anatomy& a, const SkinField& skin, Figure& out) {
  if (settings.headwear != Headwear::kBeanie && settings.headwear != Headwear::kCap) return {};
  Random random({settings.seed, 0x4a7});
  const float s = a.scale;
  const float brow = a.brow_y();
  MeshBuilder mesh;
  HatShell::Rim rim{};
  if (settings.headwear == Headwear::kBeanie) {
    rim.front = brow + static_cast<float>(random.between(0.018, 0.034)) * s;
    rim.side = a.ear_top - static_cast<float>(random.between(-0.004, 0.022)) * s;
    rim.back = a.ear_bottom + 0.01F * s;
  } else {
    rim.front = brow + static_cast<float>(random.between(0.024, 0.036)) * s;
    rim.side = a.ear_top + 0.014F * s;
    rim.back = a.ear_top - 0.012F * s;
  }
  HatShell shell(a, skin, rim);
  if (settings.headwear == Headwear::kBeanie) {
    beanie(a, shell, random, mesh);
  } else {
    cap(a, shell, random, mesh);
  }
  out.meshes.push_back(
      mesh.take(Material::kCloth, Region::kClothes, {Eigen::Vector3f::Constant(0.2F), 0.6F, 0.04F, 0.04F}));
  return shell;
}

}  // namespace faceprobe::synth
