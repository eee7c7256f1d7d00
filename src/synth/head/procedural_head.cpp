#include "faceprobe/synth/procedural_head.h"

#include "faceprobe/synth/skin_regions.h"
#include "synth/head/procedural_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace faceprobe::synth {
namespace {

using Point = Eigen::Vector2f;

// Where the 68 points lie in a frontal view, right half and middle; the left half is mirrored.
std::vector<Point> landmark_places() {
  using namespace mannequin;  // NOLINT(google-build-using-namespace): a dozen constants of this one shape
  std::vector<Point> jaw = {{-0.074F, 0.000F},  {-0.0735F, -0.020F}, {-0.072F, -0.040F},
                            {-0.067F, -0.060F}, {-0.058F, -0.080F},  {-0.046F, -0.097F},
                            {-0.031F, -0.108F}, {-0.015F, -0.115F},  {0, -0.118F}};
  const auto mirrored = [](std::vector<Point> half,
                           std::size_t keep) {  // appends the first `keep` again, from the last back
    for (std::size_t i = keep; i-- > 0;) half.emplace_back(-half[i].x(), half[i].y());
    return half;
  };
  std::vector<Point> places = mirrored(jaw, 8);
  const std::vector<Point> brow = {
      {-0.052F, 0.017F}, {-0.043F, 0.023F}, {-0.034F, 0.0245F}, {-0.024F, 0.023F}, {-0.014F, 0.020F}};
  for (const Point& p : mirrored(brow, 5)) places.push_back(p);
  const std::vector<Point> nose = {{0, 0.000F},
                                   {0, -0.014F},
                                   {0, -0.029F},
                                   {0, kNoseTipY},
                                   {-0.013F, kNoseBaseY},
                                   {-0.0065F, kNoseBaseY - 0.002F},
                                   {0, kNoseBaseY - 0.003F},
                                   {0.0065F, kNoseBaseY - 0.002F},
                                   {0.013F, kNoseBaseY}};
  places.insert(places.end(), nose.begin(), nose.end());
  const float arch = 8.0F / 9.0F;  // of the lids, a third of the way from their middle
  const std::array<Point, 6> eye = {{{-1, 0},
                                     {-1.0F / 3, kUpperLid * arch},
                                     {1.0F / 3, kUpperLid * arch},
                                     {1, 0},
                                     {1.0F / 3, -kLowerLid * arch},
                                     {-1.0F / 3, -kLowerLid * arch}}};
  for (const float side : {-1.0F, 1.0F}) {
    for (const Point& p : eye) places.emplace_back(side * kEyeX + p.x() * kEyeHalfWidth, p.y());
  }
  const float w = kMouthHalfWidth;
  for (const auto& [x, up] :
       {std::pair(-1.0F, 0.0F), {-0.55F, 0.0062F},  {-0.18F, 0.0085F}, {0.0F, 0.0078F},   {0.18F, 0.0085F},
        {0.55F, 0.0062F},       {1.0F, 0.0F},       {0.55F, -0.0085F}, {0.22F, -0.0105F}, {0.0F, -0.0110F},
        {-0.22F, -0.0105F},     {-0.55F, -0.0085F}, {-0.85F, 0.0F},    {-0.35F, 0.0007F}, {0.0F, 0.0007F},
        {0.35F, 0.0007F},       {0.85F, 0.0F},      {0.35F, -0.0007F}, {0.0F, -0.0007F},  {-0.35F, -0.0007F}}) {
    places.emplace_back(x * w, kMouthY + up);
  }
  return places;
}

// The frontmost vertex near each place.
std::vector<int> find_landmarks(const Eigen::MatrixX3f& vertices, int skin_vertices) {
  std::vector<int> landmarks;
  for (const Point& place : landmark_places()) {
    int best = -1;
    float best_distance = 0;
    for (int v = 0; v < skin_vertices; ++v) {
      if (vertices(v, 2) < -0.075F) continue;
      const float distance = (vertices.row(v).head<2>().transpose() - place).norm();
      if (best < 0 || distance < best_distance) {
        best = v;
        best_distance = distance;
      }
    }
    landmarks.push_back(best);
  }
  return landmarks;
}

Material material_of(MannequinPart part) {
  switch (part) {
    case MannequinPart::kSkin: return Material::kSkin;
    case MannequinPart::kBetweenLips: return Material::kMouth;
    case MannequinPart::kEyeball: return Material::kEye;
    case MannequinPart::kTeeth: return Material::kTeeth;
  }
  return Material::kSkin;
}

// The texture is a plain frontal view: both sides of the head share it.
constexpr float kTextureSide = 0.38F;    // metres
constexpr float kTextureFloor = -0.25F;  // height of v = 0
constexpr int kTexturePx = 512;

Eigen::MatrixX2f frontal_uv(const Eigen::MatrixX3f& vertices) {
  Eigen::MatrixX2f uv(vertices.rows(), 2);
  uv.col(0) = vertices.col(0).array() / kTextureSide + 0.5F;
  uv.col(1) = (vertices.col(1).array() - kTextureFloor) / kTextureSide;
  return uv;
}

float soft(float distance, float width) { return std::clamp(0.5F - distance / width, 0.0F, 1.0F); }

float brow_share(float x, float y) {
  const float along = (std::abs(x) - 0.013F) / 0.040F;  // 0 inner end, 1 outer
  if (along < -0.1F || along > 1.1F) return 0;
  const float middle = 0.0195F + 0.0135F * along * (1.25F - along) * 1.3F - 0.004F * along;
  const float half = 0.0038F * (1 - 0.6F * along);
  return soft(std::abs(y - middle) - half, 0.003F) * soft(std::max(-along, along - 1.0F), 0.15F);
}

float lip_share(float x, float y) {
  const float s = std::abs(x) / mannequin::kMouthHalfWidth;
  if (s >= 1.04F) return 0;
  const float up = y - mannequin::kMouthY;
  const float top = 0.0088F * (1 - s * s) - 0.0012F * std::exp(-s * s * 60.0F);
  const float bottom = -0.0108F * std::sqrt(std::max(0.0F, 1 - s * s));
  return soft(std::max(up - top, bottom - up), 0.002F);
}

ByteImage draw_texture() {
  ByteImage texture(kTexturePx, kTexturePx, 3);
  const Eigen::Vector3f skin(206, 163, 142), lips(176, 98, 94), brows(84, 62, 50);
  for (int py = 0; py < kTexturePx; ++py) {
    for (int px = 0; px < kTexturePx; ++px) {
      const float x = ((static_cast<float>(px) + 0.5F) / kTexturePx - 0.5F) * kTextureSide;
      const float y = (1 - (static_cast<float>(py) + 0.5F) / kTexturePx) * kTextureSide + kTextureFloor;
      const float flush =
          std::exp(-std::pow((std::abs(x) - 0.042F) / 0.018F, 2.0F) - std::pow((y + 0.035F) / 0.016F, 2.0F));
      Eigen::Vector3f colour = skin + flush * Eigen::Vector3f(6, -12, -10);
      colour += lip_share(x, y) * (lips - colour);
      colour += 0.85F * brow_share(x, y) * (brows - colour);
      for (int c = 0; c < 3; ++c)
        texture(px, py, c) = static_cast<std::uint8_t>(std::lround(std::clamp(colour(c), 0.0F, 255.0F)));
    }
  }
  return texture;
}

void add_modes(const MannequinBase& mean, HeadModel& model) {
  const auto difference = [&](const MannequinLook& look) -> Eigen::MatrixX3f {
    const bool plain = look.face_width == mean.face_width && look.jaw_width == mean.jaw_width;
    return mannequin_vertices(look, plain ? mean : mannequin_base(look)) - model.neutral;
  };
  for (const auto trait :
       {&MannequinLook::face_width, &MannequinLook::face_length, &MannequinLook::jaw_width, &MannequinLook::nose_length,
        &MannequinLook::nose_width, &MannequinLook::brow_ridge, &MannequinLook::lip_fullness, &MannequinLook::chin}) {
    MannequinLook look;
    look.*trait = 1;
    model.identity.push_back(difference(look));
  }
  const auto add_expression = [&](const char* name, const auto& set) {
    MannequinLook look;
    set(look);
    model.expression.push_back(difference(look));
    model.expression_names.emplace_back(name);
  };
  add_expression("jawOpen", [](MannequinLook& look) { look.jaw_open = 1; });
  add_expression("browInnerUp", [](MannequinLook& look) { look.brow_up = 1; });
  add_expression("eyeBlink_L", [](MannequinLook& look) { look.blink[0] = 1; });
  add_expression("eyeBlink_R", [](MannequinLook& look) { look.blink[1] = 1; });
  add_expression("mouthSmile_L", [](MannequinLook& look) { look.smile[0] = 1; });
  add_expression("mouthSmile_R", [](MannequinLook& look) { look.smile[1] = 1; });
}

}  // namespace

HeadModel procedural_head() {
  const MannequinGrid grid = mannequin_grid();
  HeadModel model;
  model.name = "procedural";
  const MannequinBase base = mannequin_base({});
  model.neutral = mannequin_vertices({}, base);
  model.triangles = grid.triangles;
  for (const MannequinPart part : grid.part) model.triangle_material.push_back(material_of(part));
  add_modes(base, model);
  model.uv = frontal_uv(model.neutral);
  model.triangle_uv = model.triangles;
  model.uv_layout = UvLayout::kOwn;
  model.texture = draw_texture();
  model.landmarks = find_landmarks(model.neutral, grid.skin_vertices);
  Eigen::RowVector3f eyes = Eigen::RowVector3f::Zero();
  for (std::size_t i = 36; i < 48; ++i) eyes += model.neutral.row(model.landmarks[i]) / 12.0F;
  model.neutral.rowwise() -= eyes;
  model.vertex_region = regions_from_landmarks(model);
  return model;
}

}  // namespace faceprobe::synth
