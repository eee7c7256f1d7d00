#include "synth/wardrobe/held.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/cloth.h"
#include "synth/wardrobe/draw.h"
#include "synth/wardrobe/noise.h"
#include "synth/wardrobe/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

void skin_colour(MeshBuilder& mesh, const WardrobeSettings& settings, int first) {
  mesh.colour(
      [&](const Eigen::Vector3f& p) {
        const float mottle =
            1.0F + 0.08F * noise(settings.seed, p / 0.012F) + 0.05F * noise(settings.seed + 1, p / 0.004F);
        return Eigen::Vector3f(settings.skin_tone * mottle);
      },
      first);
}

Reflectance skin_like(const Eigen::Vector3f& tone) { return {tone, 0.35F, 0.2F, 0.028F}; }

void phone(const WardrobeSettings& settings, const Anatomy& a, Random& random, Figure& out) {
  const float s = a.scale;
  const float side = random.chance(0.5) ? 1.0F : -1.0F;
  const bool call = random.chance(0.35);
  Eigen::Matrix3f turn;
  Eigen::Vector3f centre;
  if (call) {  // at the ear
    centre = Eigen::Vector3f(side * (a.skull_radii.x() + 0.024F * s), -0.055F * s, a.ear_front + 0.014F * s);
    turn =
        (Eigen::AngleAxisf(side * 1.35F, Eigen::Vector3f::UnitY()) * Eigen::AngleAxisf(-0.35F, Eigen::Vector3f::UnitZ()))
            .toRotationMatrix();
  } else {  // taking a picture in a mirror: covers some of the lower face, never the eyes
    centre = Eigen::Vector3f(side * draw(random, 0.03, 0.075) * s, a.landmark(33).y() - draw(random, 0.055, 0.08) * s,
                             a.landmark(30).z() + draw(random, 0.05, 0.10) * s);
    turn = (Eigen::AngleAxisf(draw(random, -0.2, 0.2), Eigen::Vector3f::UnitX()) *
            Eigen::AngleAxisf(draw(random, -0.25, 0.25), Eigen::Vector3f::UnitZ()))
               .toRotationMatrix();
  }
  const float half_width = 0.0365F;  // of the phone's, whatever the head's size
  const float half_height = draw(random, 0.070, 0.080);
  MeshBuilder mesh;
  const Eigen::Matrix3f box = turn * Eigen::Vector3f(half_width, half_height, 0.0042F).asDiagonal();
  mesh.rounded_box(centre, box, 9.0F, 8);
  Eigen::Vector3f shell = draw_dye(random);
  mesh.colour([&](const Eigen::Vector3f&) { return shell; });
  const int cameras = mesh.vertex_count();
  const int count = 1 + random.below(3);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f at =
        centre + turn * Eigen::Vector3f(0.022F - 0.016F * static_cast<float>(i / 2),
                                        half_height - 0.016F - 0.018F * static_cast<float>(i % 2), 0.0045F);
    mesh.ellipsoid(at, turn * Eigen::Vector3f(0.0065F, 0.0065F, 0.002F).asDiagonal(), 6, 14);
  }
  mesh.colour([](const Eigen::Vector3f&) { return Eigen::Vector3f::Constant(0.008F); }, cameras);
  out.meshes.push_back(mesh.take(Material::kObject, Region::kObject, {shell, 0.15F, 0.8F, 0.045F}));

  MeshBuilder hand;
  HandPose pose;
  pose.left = side > 0;
  if (call) {
    pose.palm = centre + Eigen::Vector3f(side * 0.020F, -0.045F, -0.005F) * s;
    pose.fingers = Eigen::Vector3f(0, 0.9F, 0.45F);
    pose.back = Eigen::Vector3f(side, 0, -0.2F);
    pose.curl = 0.12F;
  } else {
    pose.palm = centre + turn * Eigen::Vector3f(side * 0.050F, -0.06F, -0.012F);
    pose.fingers = Eigen::Vector3f(-0.55F * side, 0.8F, 0.15F);
    pose.back = Eigen::Vector3f(0.3F * side, 0.1F, 1.0F);
    pose.back = -pose.back;
    pose.curl = 0.25F;
    pose.left = !pose.left;
    pose.spread = 0.05F;
  }
  add_hand(pose, s, nullptr, hand);
  skin_colour(hand, settings, 0);
  out.meshes.push_back(hand.take(Material::kObject, Region::kObject, skin_like(settings.skin_tone)));
}

void hand_on_face(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Random& random,
                  Figure& out) {
  const float s = a.scale;
  const float side = random.chance(0.5) ? 1.0F : -1.0F;
  HandPose pose;
  const double where = random.uniform();
  pose.left = side > 0;
  if (where < 0.45) {  // fingers along the cheek, the chin rests on the palm
    pose.palm = Eigen::Vector3f(side * 0.052F * s, a.landmark(8).y() - 0.012F * s, a.landmark(8).z() - 0.004F * s);
    pose.fingers = Eigen::Vector3f(side * 0.35F, 1.0F, -0.30F);
    pose.back = Eigen::Vector3f(side, 0.1F, 0.65F);
    pose.curl = draw(random, 0.1, 0.3);
  } else if (where < 0.75) {  // before the mouth
    pose.palm = Eigen::Vector3f(side * 0.052F * s, a.landmark(57).y() - 0.022F * s, a.landmark(57).z() + 0.006F * s);
    pose.fingers = Eigen::Vector3f(-side, 0.42F, 0.12F);
    pose.back = Eigen::Vector3f(0.35F * side, 0.2F, 1.0F);
    pose.curl = draw(random, 0.12, 0.3);
  } else {  // at the chin
    pose.palm = Eigen::Vector3f(side * 0.03F * s, a.landmark(8).y() - 0.045F * s, a.landmark(8).z() + 0.012F * s);
    pose.fingers = Eigen::Vector3f(-side * 0.5F, 1.0F, 0.0F);
    pose.back = Eigen::Vector3f(0.1F * side, 0.0F, 1.0F);
    pose.curl = draw(random, 0.3, 0.5);
  }
  field.push_out(pose.palm, 0.013F * s);
  pose.spread = draw(random, 0.0, 0.6);
  MeshBuilder mesh;
  add_hand(pose, s, &field, mesh);
  skin_colour(mesh, settings, 0);
  out.meshes.push_back(mesh.take(Material::kObject, Region::kObject, skin_like(settings.skin_tone)));
}

void microphone(const WardrobeSettings& settings, const Anatomy& a, Random& random, Figure& out) {
  const float s = a.scale;
  const float side = random.chance(0.5) ? 1.0F : -1.0F;
  const Eigen::Vector3f mouth = a.landmark_mean(48, 12);
  const Eigen::Vector3f head =
      mouth +
      Eigen::Vector3f(side * draw(random, 0.0, 0.025), -draw(random, 0.022, 0.045), draw(random, 0.045, 0.07)) * s;
  const Eigen::Vector3f down =
      Eigen::Vector3f(side * draw(random, 0.1, 0.5), -1.0F, draw(random, 0.1, 0.6)).normalized();
  MeshBuilder mesh;
  mesh.ellipsoid(head, Eigen::Matrix3f::Identity() * 0.025F, 16, 24);
  const Eigen::Vector3f grille =
      random.chance(0.5) ? Eigen::Vector3f::Constant(0.02F) : Eigen::Vector3f::Constant(0.25F);
  mesh.colour([&](const Eigen::Vector3f& p) {
    return Eigen::Vector3f(grille * (0.7F + 0.3F * std::sin(p.x() / 0.0012F) * std::sin(p.y() / 0.0012F)));
  });
  const int first = mesh.vertex_count();
  const std::vector<Eigen::Vector3f> path = {head + 0.018F * down, head + 0.03F * down, head + 0.06F * down,
                                             head + 0.18F * down};
  const std::vector<float> radii = {0.021F, 0.019F, 0.016F, 0.012F};
  mesh.tube(path, radii, 20);
  mesh.colour([](const Eigen::Vector3f&) { return Eigen::Vector3f::Constant(0.015F); }, first);
  out.meshes.push_back(
      mesh.take(Material::kObject, Region::kObject, {Eigen::Vector3f::Constant(0.05F), 0.25F, 0.4F, 0.05F}));
  MeshBuilder hand;
  HandPose pose;
  pose.left = side > 0;
  pose.palm = head + 0.105F * down + Eigen::Vector3f(side * 0.022F, 0, -0.004F);
  pose.fingers = Eigen::Vector3f(-side, 0.35F, 0.5F);
  pose.back = Eigen::Vector3f(side * 0.5F, 0.2F, 1.0F);
  pose.curl = 0.75F;
  add_hand(pose, s, nullptr, hand);
  skin_colour(hand, settings, 0);
  out.meshes.push_back(hand.take(Material::kObject, Region::kObject, skin_like(settings.skin_tone)));
}

void cup(const WardrobeSettings& settings, const Anatomy& a, Random& random, Figure& out) {
  const float s = a.scale;
  const float side = random.chance(0.5) ? 1.0F : -1.0F;
  const Eigen::Vector3f lip = a.landmark(57);
  const float radius = draw(random, 0.036, 0.042);
  const float height = draw(random, 0.085, 0.11);
  const Eigen::Vector3f up = Eigen::Vector3f(0.05F * side, 1.0F, -draw(random, 0.05, 0.35)).normalized();
  const Eigen::Vector3f ahead = (Eigen::Vector3f(0, 0, 1) - up * up.z()).normalized();
  const Eigen::Vector3f across = up.cross(ahead);
  // The rim at the lower lip, or a little below, about to drink.
  const Eigen::Vector3f rim =
      lip + Eigen::Vector3f(0, -draw(random, 0.002, 0.03), draw(random, 0.006, 0.03)) * s + radius * ahead;
  const bool paper = random.chance(0.5);
  struct Level {
    float down, out;
  };
  const float foot = paper ? 0.76F : 0.95F;
  const std::vector<Level> levels = {{0.6F, 0.85F * (0.6F * foot + 0.4F)},
                                     {0.05F, 0.93F},
                                     {0.0F, 0.97F},
                                     {0.0F, 1.0F},
                                     {0.03F, 1.0F},
                                     {0.35F, 0.65F + 0.35F * foot},
                                     {0.7F, 0.3F + 0.7F * foot},
                                     {0.97F, foot},
                                     {1.0F, 0.93F * foot},
                                     {1.0F, 0.02F}};
  std::vector<Eigen::Vector3f> points;
  constexpr int kAround = 40;
  for (const Level& level : levels) {
    for (int i = 0; i < kAround; ++i) {
      const float angle = kTurn * static_cast<float>(i) / kAround;
      points.emplace_back(rim - level.down * height * up +
                          level.out * radius * (std::sin(angle) * across + std::cos(angle) * ahead));
    }
  }
  MeshBuilder mesh;
  for (std::size_t r = 0; r < levels.size(); ++r) {  // rows lead downwards outside: turned so that normals point out
    std::reverse(points.begin() + static_cast<std::ptrdiff_t>(r * kAround),
                 points.begin() + static_cast<std::ptrdiff_t>((r + 1) * kAround));
  }
  std::vector<Eigen::Vector3f> outside(points);
  mesh.grid(outside, kAround, true);
  Eigen::Vector3f glaze = draw_dye(random);
  const Eigen::Vector3f sleeve = draw_dye(random);
  mesh.colour([&](const Eigen::Vector3f& p) {
    const float down = (rim - p).dot(up) / height;
    return paper && down > 0.3F && down < 0.8F ? sleeve : glaze;
  });
  if (!paper) {
    const int first = mesh.vertex_count();
    const Eigen::Vector3f out_dir = (-side * across + 0.3F * ahead).normalized();
    const std::vector<Eigen::Vector3f> handle = {
        rim - 0.2F * height * up + 0.98F * radius * out_dir, rim - 0.22F * height * up + (radius + 0.02F) * out_dir,
        rim - 0.6F * height * up + (radius + 0.024F) * out_dir, rim - 0.75F * height * up + 0.98F * radius * out_dir};
    mesh.tube(smooth_path(handle, 6), 0.0045F, 10);
    mesh.colour([&](const Eigen::Vector3f&) { return glaze; }, first);
  }
  out.meshes.push_back(mesh.take(Material::kObject, Region::kObject, {glaze, 0.12F, paper ? 0.2F : 0.9F, 0.045F}));
  MeshBuilder hand;
  HandPose pose;
  pose.left = side > 0;
  pose.palm = rim - 0.62F * height * up + side * (radius + 0.012F) * across - 0.005F * ahead;
  pose.fingers = Eigen::Vector3f(-0.25F * side, 0.1F, 1.0F);
  pose.back = Eigen::Vector3f(side, 0.0F, 0.3F);
  pose.curl = 0.5F;
  add_hand(pose, s, nullptr, hand);
  skin_colour(hand, settings, 0);
  out.meshes.push_back(hand.take(Material::kObject, Region::kObject, skin_like(settings.skin_tone)));
}

}  // namespace

void add_mask(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Figure& out) {
  Random random({settings.seed, 0x3a5c});
  const float s = a.scale;
  const double look = random.uniform();
  const Eigen::Vector3f colour = look < 0.45   ? Eigen::Vector3f(0.25F, 0.50F, 0.66F)
                                 : look < 0.65 ? Eigen::Vector3f::Constant(0.75F)
                                 : look < 0.85 ? Eigen::Vector3f::Constant(0.025F)
                                               : draw_dye(random);
  const float off = draw(random, 0.004, 0.007) * s;
  // Below the eyes, and lower under glasses.
  const float lower = settings.glasses != Glasses::kNone ? 0.006F : 0.0F;
  const float top = a.landmark(28).y() + (draw(random, -0.012, 0.001) - lower) * s;
  const float side_top = 0.5F * (a.landmark(28).y() + a.landmark(33).y()) - 0.006F * s;
  const float bottom = a.landmark(8).y() - 0.004F * s;
  const float side_bottom = a.landmark(57).y() - 0.012F * s;
  const Eigen::Vector3f axis(0, 0, a.ear_front - 0.005F * s);
  constexpr int kColumns = 61;
  constexpr int kRows = 41;
  const float half = static_cast<float>(radians(74));
  std::vector<float> reach(kColumns * kRows);
  const auto height_at = [&](int r, int c) {
    const float u = 2.0F * static_cast<float>(c) / (kColumns - 1) - 1.0F;
    const float high = top + (side_top - top) * smooth_step(0.05F, 1.0F, std::abs(u));
    const float low = bottom + (side_bottom - bottom) * u * u;
    return low + (high - low) * static_cast<float>(r) / (kRows - 1);
  };
  const auto outwards = [&](int c) -> Eigen::Vector3f {
    const float angle = half * (2.0F * static_cast<float>(c) / (kColumns - 1) - 1.0F);
    return {std::sin(angle), 0, std::cos(angle)};
  };
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c) {
      float out_m = 0.14F * s;
      while (out_m > 0.03F * s) {
        const float gap = field.distance(Eigen::Vector3f(axis.x(), height_at(r, c), axis.z()) + out_m * outwards(c));
        if (gap < 0.0005F) break;
        out_m -= std::max(0.6F * gap, 0.0005F);
      }
      reach[static_cast<std::size_t>(r * kColumns + c)] = out_m;
    }
  }
  // Cloth is tight: it spans what lies between nose, cheeks and chin.
  for (int pass = 0; pass < 60; ++pass) {
    for (int r = 1; r + 1 < kRows; ++r) {
      for (int c = 1; c + 1 < kColumns; ++c) {
        float& here = reach[static_cast<std::size_t>(r * kColumns + c)];
        const auto at = [&](int y, int x) { return reach[static_cast<std::size_t>(y * kColumns + x)]; };
        here = std::max(
            here, std::max(0.5F * (at(r, c - 1) + at(r, c + 1)), 0.5F * (at(r - 1, c) + at(r + 1, c))) - 0.0002F * s);
      }
    }
  }
  std::vector<Eigen::Vector3f> points;
  const bool pleated = random.chance(0.7);
  for (int r = 0; r < kRows; ++r) {
    const float v = static_cast<float>(r) / (kRows - 1);
    for (int c = 0; c < kColumns; ++c) {
      const float u = 2.0F * static_cast<float>(c) / (kColumns - 1) - 1.0F;
      const float edge = std::min({1.0F, 8.0F * v, 8.0F * (1 - v), 8.0F * (1 - std::abs(u))});
      float room = off * (0.25F + 0.75F * edge);
      if (pleated) room += 0.0014F * s * edge * (2.0F * (4.0F * v - std::floor(4.0F * v)) - 1.0F);
      room += 0.001F * s * noise(settings.seed + 2, Eigen::Vector3f(6.0F * u, 9.0F * v, 0));
      const float out_m = reach[static_cast<std::size_t>(r * kColumns + c)] + room;
      points.emplace_back(Eigen::Vector3f(axis.x(), height_at(r, c), axis.z()) + out_m * outwards(c));
    }
  }
  MeshBuilder mesh;
  mesh.grid(points, kColumns, false);
  mesh.colour([&](const Eigen::Vector3f& p) {
    return Eigen::Vector3f(colour * (1.0F + 0.05F * noise(settings.seed, p / 0.003F)));
  });
  const int first = mesh.vertex_count();
  for (const bool left : {false, true}) {
    const int c = left ? kColumns - 1 : 0;
    const float side = left ? 1.0F : -1.0F;
    for (const int r : {2, kRows - 3}) {
      const Eigen::Vector3f from = points[static_cast<std::size_t>(r * kColumns + c)];
      const float ear_y = r > 2 ? a.ear_top - 0.003F * s : a.ear_bottom + 0.004F * s;
      const Eigen::Vector3f ear(side * (a.skull_radii.x() + 0.001F * s), ear_y, 0.6F * a.ear_front + 0.4F * a.ear_back);
      std::vector<Eigen::Vector3f> path;
      for (int i = 0; i <= 12; ++i) path.emplace_back(from + (ear - from) * static_cast<float>(i) / 12.0F);
      for (int i = 1; i < 10; ++i) field.push_out(path[static_cast<std::size_t>(i)], 0.0012F * s);
      mesh.tube(path, 0.0011F * s, 6);
    }
  }
  mesh.colour([](const Eigen::Vector3f&) { return Eigen::Vector3f::Constant(0.7F); }, first);
  out.meshes.push_back(mesh.take(Material::kObject, Region::kObject, {colour, 0.5F, 0.06F, 0.04F}));
}

void add_held(const WardrobeSettings& settings, const Anatomy& a, const SkinField& field, Figure& out) {
  Random random({settings.seed, 0x4e1d});
  switch (settings.held) {
    case Held::kNone: return;
    case Held::kPhone: phone(settings, a, random, out); return;
    case Held::kHand: hand_on_face(settings, a, field, random, out); return;
    case Held::kMicrophone: microphone(settings, a, random, out); return;
    case Held::kCup: cup(settings, a, random, out); return;
    case Held::kMask: add_mask(settings, a, field, out); return;
  }
}

}  // namespace faceprobe::synth
