#include "synth/wardrobe/torso.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/cloth.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

enum class Garment : std::uint8_t { kTee, kShirt, kHoodie, kJacket };

constexpr int kAround = 96;

// From the collar down, in three directions from the neck's axis: distance from it and height below the chin, of an average body.
struct Station {
  float front_out, front_down;
  float side_out, side_down;
  float back_out, back_down;
};
constexpr std::array<Station, 9> kBody = {{{0.058F, 0.050F, 0.066F, 0.028F, 0.060F, 0.022F},
                                           {0.064F, 0.060F, 0.078F, 0.031F, 0.071F, 0.032F},
                                           {0.074F, 0.080F, 0.105F, 0.038F, 0.086F, 0.048F},
                                           {0.086F, 0.105F, 0.145F, 0.053F, 0.101F, 0.074F},
                                           {0.096F, 0.135F, 0.180F, 0.082F, 0.110F, 0.108F},
                                           {0.104F, 0.180F, 0.205F, 0.140F, 0.116F, 0.160F},
                                           {0.112F, 0.240F, 0.220F, 0.220F, 0.120F, 0.240F},
                                           {0.116F, 0.330F, 0.225F, 0.330F, 0.120F, 0.330F},
                                           {0.112F, 0.620F, 0.210F, 0.620F, 0.116F, 0.620F}}};
constexpr float kLast = 8.0F;  // its last station

struct Frame {
  Eigen::Vector3f neck;  // on the axis, at the chin's height
  float scale;
  float width;  // of shoulders, against average

  // The body's surface; `station` 0 .. kLast, azimuth 0 = front, towards +x.
  Eigen::Vector3f at(float station, float azimuth) const {
    const float clamped = std::clamp(station, 0.0F, kLast - 0.001F);
    const auto k = static_cast<std::size_t>(clamped);
    const float t = clamped - static_cast<float>(k);
    const auto mix = [&](float Station::*member) {
      return kBody[k].*member + t * (kBody[k + 1].*member - kBody[k].*member);
    };
    const float c = std::cos(azimuth);
    const float n = std::sin(azimuth);
    const float out = c > 0 ? mix(&Station::front_out) : mix(&Station::back_out);
    const float side = 1.0F + (width - 1.0F) * std::min(1.0F, clamped / 7.0F);
    const float down =
        n * n * mix(&Station::side_down) + c * c * (c > 0 ? mix(&Station::front_down) : mix(&Station::back_down));
    // Between a rounded box and an ellipse.
    const auto round = [](float x) { return std::copysign(std::pow(std::abs(x), 0.85F), x); };
    return neck + scale * Eigen::Vector3f(mix(&Station::side_out) * side * round(n), -down, out * round(c));
  }
};

constexpr float kWidest = 1.15F;

Frame frame_of(const Anatomy& a, float width) {
  // A neck that ends early pulls the collar up to it.
  const float s = a.scale;
  const float chin = a.landmark(8).y();
  const float lowest = a.skin.vertices.col(1).minCoeff();
  const float y = std::clamp(lowest + 0.075F * s, chin, chin + 0.03F * s);
  return {Eigen::Vector3f(a.neck_centre.x(), y, a.neck_centre.z()), s, width};
}

// Sharp V or round hole at the front: how far below its collar a garment begins at an azimuth, in stations.
float opening(Garment kind, float azimuth) {
  const float front = std::max(0.0F, std::cos(azimuth));
  switch (kind) {
    case Garment::kTee: return 0.5F + 0.3F * front * front;
    case Garment::kShirt: return 0.1F;
    case Garment::kHoodie: return 0.3F + 0.5F * front * front;
    case Garment::kJacket: return 0.2F;
  }
  return 0;
}

}  // namespace

Eigen::Vector3f body_at(const Anatomy& a, float station, float azimuth, float room_m) {
  const Frame body = frame_of(a, kWidest);
  Eigen::Vector3f p = body.at(station, azimuth);
  const Eigen::Vector3f outwards = Eigen::Vector3f(p.x() - body.neck.x(), 0, p.z() - body.neck.z()).normalized();
  // Shoulders face up, chest and back ahead.
  const float shoulder = std::min(1.0F, std::max(0.0F, station)) * std::abs(std::sin(azimuth));
  p += room_m * (outwards + 1.2F * shoulder * Eigen::Vector3f(0, 1, 0)).normalized();
  if (station < 0) p += -station * a.scale * (Eigen::Vector3f(0, 0.02F, 0) - 0.002F * outwards);
  return p;
}

SurfaceMesh make_torso(const WardrobeSettings& settings, const Anatomy& a, const SkinField& skin) {
  Random random({settings.seed, 0x70250});
  const float s = a.scale;
  const double look = random.uniform();
  // Under a scarf nothing stands up.
  const Garment kind = settings.headwear == Headwear::kScarf ? Garment::kTee
                       : look < 0.45                         ? Garment::kTee
                       : look < 0.7                          ? Garment::kShirt
                       : look < 0.85                         ? Garment::kHoodie
                                                             : Garment::kJacket;
  const Cloth cloth = draw_cloth(random, kind != Garment::kJacket);
  const Cloth under = draw_cloth(random, false);
  const Frame body = frame_of(a, static_cast<float>(random.between(0.9, kWidest)));
  const float thick = kind == Garment::kHoodie ? 0.006F * s : kind == Garment::kJacket ? 0.006F * s : 0.003F * s;
  const std::uint64_t seed = random.bits();

  const auto azimuth_of = [](int i) { return static_cast<float>(2 * kPi) * static_cast<float>(i) / kAround; };
  const auto fold = [&](Eigen::Vector3f p, float depth) {
    p += depth * s * noise3(seed, p.cwiseProduct(Eigen::Vector3f(1.0F, 0.45F, 1.0F)) / (0.035F * s));
    return p;
  };
  MeshBuilder mesh;
  std::vector<Eigen::Vector3f> points;
  // Inner wall first: it goes down behind the collar so that nothing shows between cloth and neck. Rows run downwards, columns
  // from the front to +x.
  constexpr int kRows = 38;
  std::vector<Eigen::Vector3f> collar;
  for (int r = 0; r < kRows; ++r) {
    for (int i = 0; i < kAround; ++i) {
      const float azimuth = azimuth_of(i);
      const float begin = opening(kind, azimuth);
      const Eigen::Vector3f edge = body.at(begin, azimuth);
      Eigen::Vector3f p;
      float clearance = thick;
      if (r < 3) {
        p = edge;
        const Eigen::Vector3f inwards = Eigen::Vector3f(body.neck.x() - p.x(), 0, body.neck.z() - p.z()).normalized();
        p += inwards * (0.004F * s) + Eigen::Vector3f(0, -0.006F * s * static_cast<float>(2 - r), 0);
        clearance = 0.001F * s;
      } else {
        const float t = static_cast<float>(r - 3) / static_cast<float>(kRows - 4);
        p = body.at(begin + (kLast - begin) * std::pow(t, 1.3F), azimuth);
        p = fold(p, 0.004F * smooth_step(0.05F, 0.4F, t));
      }
      skin.push_out(p, clearance);
      if (r == 3) collar.push_back(p);
      points.push_back(p);
    }
  }
  mesh.grid(points, kAround, true, true);
  mesh.colour([&](const Eigen::Vector3f& p) {
    if (kind == Garment::kJacket) {  // a V of what is worn below
      const float below = (collar[0].y() + 0.01F * s - p.y());
      if (p.z() > body.neck.z() && std::abs(p.x() - body.neck.x()) < 0.036F * s - 0.2F * below) return under.at(p);
    }
    return cloth.at(p);
  });

  const int first = mesh.vertex_count();
  std::vector<float> radii;
  switch (kind) {
    case Garment::kTee: mesh.tube(collar, 0.0026F * s, 6, true); break;
    case Garment::kHoodie:
      for (int i = 0; i < kAround; ++i) {
        const float back = 0.5F - 0.5F * std::cos(azimuth_of(i));
        radii.push_back((0.006F + 0.016F * back) * s);
        collar[static_cast<std::size_t>(i)] = fold(collar[static_cast<std::size_t>(i)], 0.004F) +
                                              Eigen::Vector3f(0, 0.004F * s * back, -0.008F * s * back);
      }
      mesh.tube(collar, radii, 8, true);
      break;
    case Garment::kShirt:
    case Garment::kJacket: {
      // Stands up around the neck, folds over, and is open in front.
      constexpr int kSpan = 80;
      const float gap = kind == Garment::kShirt ? 0.16F : 0.45F;
      const float stand = kind == Garment::kShirt ? 0.022F : 0.014F;
      points.clear();
      // From the neck's side up, over, and down outside.
      for (int row = 0; row < 9; ++row) {
        for (int i = 0; i <= kSpan; ++i) {
          const float azimuth = gap + (static_cast<float>(2 * kPi) - 2 * gap) * static_cast<float>(i) / kSpan;
          const float front = std::max(0.0F, std::cos(azimuth));
          Eigen::Vector3f p = body.at(opening(kind, azimuth), azimuth);
          const Eigen::Vector3f outwards = Eigen::Vector3f(p.x() - body.neck.x(), 0, p.z() - body.neck.z()).normalized();
          const float height = stand * (1.0F - 0.3F * front);
          const float leaf = (0.036F + 0.026F * std::pow(front, 4.0F));
          float clearance = 0.002F * s;
          if (row < 4) {
            const float t = static_cast<float>(row) / 3.0F;
            p += (height * t * Eigen::Vector3f(0, 1, 0) - 0.004F * t * outwards) * s;
          } else {
            const float t = static_cast<float>(row - 3) / 5.0F;
            p += ((height - leaf * t) * Eigen::Vector3f(0, 1, 0) + (0.002F + 0.022F * t) * outwards) * s;
            clearance = thick + 0.004F * s;
          }
          skin.push_out(p, clearance);
          points.push_back(p);
        }
      }
      mesh.grid(points, kSpan + 1, false, true);
      break;
    }
  }
  mesh.colour([&](const Eigen::Vector3f& p) -> Eigen::Vector3f { return 0.92F * cloth.at(p); }, first);
  Reflectance reflectance{cloth.colour, 0.6F, 0.04F, 0.04F};
  return mesh.take(Material::kCloth, Region::kClothes, reflectance);
}

}  // namespace faceprobe::synth
