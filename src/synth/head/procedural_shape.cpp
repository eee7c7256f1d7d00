#include "synth/head/procedural_shape.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/smooth_step.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace faceprobe::synth {
namespace {

using mannequin::kEyeHalfWidth;
using mannequin::kEyeX;
using mannequin::kMouthHalfWidth;
using mannequin::kMouthY;
using Vector = Eigen::Vector3f;

float square(float x) { return x * x; }
// A bump of height 1 and the given radii on the face's plane.
float bump(float x, float y, float rx, float ry) { return std::exp(-square(x / rx) - square(y / ry)); }

// First-order distance to an ellipsoid: its implicit function over the length of its gradient.
float ellipsoid(const Vector& p, const Vector& radii) {
  const float k = p.cwiseQuotient(radii).norm();
  return k * (k - 1) / std::max(1e-6F, p.cwiseQuotient(radii.cwiseAbs2()).norm());
}

// Skull, face, jaw and neck melted into one another.
float head_distance(const MannequinLook& look, const Vector& p) {
  constexpr float kMelt = 0.009F;
  const float wide = 1 + 0.035F * look.face_width;
  const Vector neck(p.x(), 0, p.z() + 0.088F - 0.10F * (p.y() + 0.06F));
  const float neck_end = p.y() > -0.06F ? p.y() + 0.06F : 0.0F;
  const float parts[] = {
      ellipsoid(p - Vector(0, 0.030F, -0.085F), {0.075F * wide, 0.090F, 0.096F}),
      ellipsoid(p - Vector(0, -0.034F, -0.042F), {0.062F * wide, 0.074F, 0.050F}),
      ellipsoid(p - Vector(0, -0.084F, -0.040F), {(0.044F + 0.004F * look.jaw_width) * wide, 0.031F, 0.045F}),
      std::hypot(neck.norm(), neck_end) - 0.050F,
  };
  float sum = 0;
  for (const float distance : parts) sum += std::exp(-distance / kMelt);
  return -kMelt * std::log(std::max(sum, 1e-30F));
}

// The grid: rings at fixed heights, each with its columns denser in front.
constexpr int kColumns = 72;
struct Span {
  float from, to;
  int rows;
};
// Rows are close where eyes and mouth are. The two rows next to kMouthY edge the gap between the lips.
constexpr float kLipGap = 0.0007F;
constexpr Span kSpans[] = {
    {-0.240F, -0.130F, 8},           {-0.130F, -0.096F, 9},           {-0.096F, kMouthY - kLipGap, 9},
    {kMouthY - kLipGap, kMouthY, 1}, {kMouthY, kMouthY + kLipGap, 1}, {kMouthY + kLipGap, -0.058F, 9},
    {-0.058F, -0.012F, 14},          {-0.012F, 0.012F, 14},           {0.012F, 0.040F, 8}};
constexpr int kCrownRows = 11;
constexpr float kAxisZ = -0.066F;

float crown_height(const MannequinLook& look) {
  float inside = 0.08F;
  float outside = 0.15F;
  for (int i = 0; i < 20; ++i) {
    const float middle = (inside + outside) / 2;
    (head_distance(look, {0, middle, kAxisZ}) > 0 ? outside : inside) = middle;
  }
  return inside;
}

std::vector<float> ring_heights() {
  std::vector<float> heights;
  for (const Span& span : kSpans) {
    for (int i = 0; i < span.rows; ++i) {
      heights.push_back(span.from + (span.to - span.from) * static_cast<float>(i) / static_cast<float>(span.rows));
    }
  }
  const float first = kSpans[std::size(kSpans) - 1].to;
  const float top = crown_height({}) - 0.0002F;
  for (int i = 0; i < kCrownRows; ++i) {
    heights.push_back(first + (top - first) * std::sin(static_cast<float>(kPi) / 2 * static_cast<float>(i) /
                                                       static_cast<float>(kCrownRows)));
  }
  return heights;
}

float column_azimuth(int column) {
  const double s = 2.0 * column / kColumns - 1.0;  // -1 and 1 are behind
  return static_cast<float>(kPi * s - 0.62 * std::sin(kPi * s));
}

// The plain head at a height, seen from its axis.
Vector plain_point(const MannequinLook& look, float y, float azimuth) {
  const Vector axis(0, y, kAxisZ - 0.024F * smooth_step(-0.095F, -0.135F, y));
  const Vector outwards(std::sin(azimuth), 0, std::cos(azimuth));
  constexpr float kStep = 0.004F;
  float outside = 0.132F;
  while (outside > kStep && head_distance(look, axis + (outside - kStep) * outwards) > 0) outside -= kStep;
  float inside = std::max(0.0F, outside - kStep);
  for (int i = 0; i < 14; ++i) {
    const float middle = (inside + outside) / 2;
    (head_distance(look, axis + middle * outwards) > 0 ? outside : inside) = middle;
  }
  return axis + outside * outwards;
}

float nose_height(const MannequinLook& look, float x, float y) {
  using namespace mannequin;  // NOLINT(google-build-using-namespace): a dozen constants of this one shape
  const float length = 1 + 0.12F * look.nose_length;
  const float wide = 1 + 0.12F * look.nose_width;
  const float along = (0.012F - y) / (0.012F - kNoseTipY);  // 0 at the bridge, 1 at the tip
  float ridge = 0;
  if (along > 0 && along <= 1) ridge = 0.002F + 0.019F * std::pow(along, 1.3F);
  if (along > 1) ridge = 0.021F * (1 - smooth_step(kNoseTipY + 0.001F, kNoseBaseY - 0.003F, y));
  ridge *= smooth_step(-0.15F, 0.15F, along);
  const float half_width = (0.0065F + 0.005F * std::clamp(along, 0.0F, 1.0F)) * wide;
  float height = length * ridge * bump(x, 0, half_width, 1);
  for (const float side : {-1.0F, 1.0F}) {
    height += 0.0085F * bump(x - side * 0.0125F * wide, y + 0.0485F, 0.0058F, 0.0052F);  // wings
    height -= 0.0050F * bump(x - side * 0.0065F, y + 0.0545F, 0.0035F, 0.0025F);         // nostrils
  }
  return height;
}

float lips_height(const MannequinLook& look, float x, float y) {
  const float full = 1 + 0.22F * look.lip_fullness;
  const float across = std::max(0.0F, 1 - square(x / (kMouthHalfWidth + 0.002F)));
  const float bow = 1 - 0.25F * bump(x, 0, 0.004F, 1);
  const float up = y - kMouthY;
  const float upper = 0.0046F * bow * bump(0, up - 0.0042F, 1, 0.0042F);
  const float lower = 0.0056F * bump(0, up + 0.0052F, 1, 0.0050F);
  const float gap = 0.0022F * bump(0, up, 1, 0.0012F);
  const float around = 0.0030F * bump(x, up, 0.028F, 0.016F);  // the teeth behind push the whole mouth forward
  return around + std::sqrt(across) * (full * (upper + lower) - gap) - 0.0030F * bump(x, y + 0.0935F, 0.018F, 0.0045F);
}

// All that stands out of the face or lies in it, along +z.
float relief(const MannequinLook& look, float x, float y) {
  float z = nose_height(look, x, y) + lips_height(look, x, y);
  z += (0.0075F + 0.0015F * look.chin) * bump(x, y + 0.111F, 0.017F, 0.012F);
  const float ridge_y = y - 0.021F + 3.0F * square(std::abs(x) - 0.025F);
  z += (0.0042F + 0.0015F * look.brow_ridge) * bump(0, ridge_y, 1, 0.0085F) * smooth_step(0.062F, 0.045F, std::abs(x));
  for (const float side : {-1.0F, 1.0F}) {
    z -= 0.0065F * bump(x - side * 0.030F, y - 0.001F, 0.019F, 0.013F);  // socket
    z += 0.0045F * bump(x - side * 0.047F, y + 0.030F, 0.020F, 0.017F);  // cheekbone
    z -= 0.0025F * bump(x - side * 0.050F, y + 0.070F, 0.020F, 0.022F);  // hollow of the cheek
    z -= 0.0035F * bump(x - side * (0.020F + 0.35F * std::max(0.0F, -y - 0.05F)), y + 0.062F, 0.0045F,
                        0.014F);  // fold beside the mouth
  }
  return z;
}

constexpr float kEyeRadius = 0.0122F;
constexpr float kEyeZ = -0.0135F;

// Lids lie on the eyeball; where they part the skin dives behind it, and the rim is where the two surfaces cross.
Vector lay_lids(const MannequinLook& look, const Vector& p) {
  const bool left = p.x() > 0;
  const float dx = std::abs(p.x()) - kEyeX;
  const float distance = std::hypot(dx, p.y());
  const float near_eye = 1 - smooth_step(0.80F * kEyeRadius, 1.55F * kEyeRadius, distance);
  if (near_eye <= 0 || p.z() < -0.03F) return p;
  const float blink = look.blink[left ? 0 : 1];
  const float arch = 1 - square(dx / kEyeHalfWidth);
  const float upper = ((1 - blink) * mannequin::kUpperLid - blink * (mannequin::kLowerLid + 0.001F)) * arch;
  const float lower = -mannequin::kLowerLid * arch;
  const float beyond = std::max(p.y() - upper, lower - p.y());  // > 0 on the lids
  const float margin = beyond > 0 ? 0.0016F * std::min(1.0F, beyond / 0.0022F) : std::max(-0.0030F, 1.2F * beyond);
  const float ball = kEyeZ + std::sqrt(std::max(square(kEyeRadius) - square(distance), square(0.45F * kEyeRadius)));
  return {p.x(), p.y(), p.z() + near_eye * (ball + margin - p.z())};
}

Vector raise_ears(const Vector& p) {
  const float side = p.x() > 0 ? 1.0F : -1.0F;
  if (std::abs(p.x()) < 0.045F) return p;
  const float y = p.y() + 0.016F;
  const float z = p.z() + 0.083F - 0.15F * y;
  const float shell = bump(z, y, 0.016F, 0.028F);
  const float rim = shell * smooth_step(0.004F, -0.010F, z) - 0.35F * bump(z + 0.002F, y - 0.004F, 0.007F, 0.012F);
  return p + Vector(side * (0.004F * shell + 0.021F * std::max(0.0F, rim)), 0, -0.006F * shell);
}

// Face length, jaw, smile, brows: the finished surface moved.
Vector move(const MannequinLook& look, const Vector& p) {
  Vector q = p;
  const float front = smooth_step(-0.075F, -0.030F, p.z());
  if (p.y() < 0)
    q.y() *= 1 + 0.035F * look.face_length * std::min(1.0F, -p.y() / 0.03F) * smooth_step(-0.24F, -0.12F, p.y());
  for (const int side : {0, 1}) {
    const float sign = side == 0 ? 1.0F : -1.0F;
    const float smile = look.smile[static_cast<std::size_t>(side)];
    const float corner = front * smile * bump(p.x() - sign * 0.027F, p.y() - kMouthY, 0.017F, 0.016F);
    q += corner * Vector(sign * 0.0065F, 0.0075F, -0.0045F);
    const float cheek = front * smile * bump(p.x() - sign * 0.042F, p.y() + 0.036F, 0.016F, 0.014F);
    q += cheek * Vector(0, 0.0025F, 0.0035F);
  }
  q.y() +=
      0.0065F * look.brow_up * front * bump(std::max(0.0F, std::abs(p.x()) - 0.035F), p.y() - 0.026F, 0.02F, 0.013F);
  return q;
}

// The lower jaw turns about an axis through both ears; between the lips the surface is drawn into the mouth.
constexpr float kJawOpenRadians = 0.20F;
Vector open_jaw(const MannequinLook& look, const Vector& p, float ring_y, bool between_lips) {
  const float across = 1 - square(p.x() / kMouthHalfWidth);
  const float gap = kLipGap * 0.9F;
  // Above the corners' height nothing follows the jaw; outside the mouth the cheeks stretch gently.
  const float soft = smooth_step(-0.066F, -0.098F, ring_y);
  const float hard = ring_y < kMouthY - gap ? 1.0F : ring_y > kMouthY + gap ? 0.0F : 0.5F;
  const float in_mouth = std::sqrt(std::max(0.0F, across));
  const float front = smooth_step(-0.11F, -0.07F, p.z()) * smooth_step(-0.150F, -0.120F, ring_y);
  const float share = front * (in_mouth * hard + (1 - in_mouth) * soft) * look.jaw_open;
  Vector q = p;
  if (share > 0) {
    const Vector hinge(0, -0.015F, -0.075F);
    const float angle = kJawOpenRadians * share;
    const Vector d = p - hinge;
    q.y() = hinge.y() + std::cos(angle) * d.y() - std::sin(angle) * d.z();
    q.z() = hinge.z() + std::sin(angle) * d.y() + std::cos(angle) * d.z();
  }
  if (between_lips && across > 0) q.z() -= (0.0035F + 0.016F * look.jaw_open) * in_mouth;
  return q;
}

Vector skin_point(const MannequinLook& look, const Vector& plain, float ring_y) {
  Vector p = plain;
  const float front = smooth_step(-0.065F, -0.030F, p.z());
  if (front > 0) p.z() += front * relief(look, p.x(), p.y());
  p = lay_lids(look, raise_ears(p));
  p = open_jaw(look, p, ring_y, std::abs(ring_y - kMouthY) < 1e-6F && p.z() > -0.03F);
  return move(look, p);
}

// Rings of an eyeball from its back to its front, then the cornea's middle. The cornea bulges by 1 mm.
constexpr int kEyeRings = 12, kEyeColumns = 20;
Vector eye_point(int side, int ring, int column) {
  const auto polar =
      static_cast<float>(kPi) * (1.0F - static_cast<float>(ring) / static_cast<float>(kEyeRings));  // 0 = front
  const auto turn = static_cast<float>(2.0 * kPi * column / kEyeColumns);
  const float radius = kEyeRadius * (1 + 0.06F * (1 - smooth_step(0.25F, 0.50F, polar)));
  return Vector(side == 0 ? kEyeX : -kEyeX, 0, kEyeZ) +
         radius * Vector(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
}

// The upper teeth, a curved band behind the upper lip.
constexpr int kTeethColumns = 16, kTeethRows = 3;
Vector tooth_point(int row, int column) {
  const float s = 2.0F * static_cast<float>(column) / kTeethColumns - 1.0F;
  const float up = 0.006F - 0.009F * static_cast<float>(row) / static_cast<float>(kTeethRows - 1);
  return {0.021F * s, kMouthY + up, 0.0045F - 0.014F * s * s};
}

}  // namespace

MannequinBase mannequin_base(const MannequinLook& look) {
  MannequinBase base;
  base.face_width = look.face_width;
  base.jaw_width = look.jaw_width;
  for (const float y : ring_heights()) {
    for (int column = 0; column < kColumns; ++column)
      base.points.push_back(plain_point(look, y, column_azimuth(column)));
  }
  return base;
}

Eigen::MatrixX3f mannequin_vertices(const MannequinLook& look, const MannequinBase& base) {
  assert(look.face_width == base.face_width && look.jaw_width == base.jaw_width);
  const std::vector<float> heights = ring_heights();
  std::vector<Vector> points;
  for (std::size_t i = 0; i < base.points.size(); ++i)
    points.push_back(skin_point(look, base.points[i], heights[i / kColumns]));
  points.push_back(move(look, {0, crown_height(look), kAxisZ}));
  for (const int side : {0, 1}) {
    for (int ring = 0; ring <= kEyeRings; ++ring) {
      for (int column = 0; column < kEyeColumns; ++column) points.push_back(eye_point(side, ring, column));
    }
  }
  for (int row = 0; row < kTeethRows; ++row) {
    for (int column = 0; column <= kTeethColumns; ++column) points.push_back(move(look, tooth_point(row, column)));
  }
  Eigen::MatrixX3f vertices(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) vertices.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return vertices;
}

MannequinGrid mannequin_grid() {
  const std::vector<float> heights = ring_heights();
  const MannequinLook mean;
  std::vector<Eigen::RowVector3i> triangles;
  MannequinGrid grid;
  const auto add = [&](int a, int b, int c, MannequinPart part) {
    triangles.emplace_back(a, b, c);
    grid.part.push_back(part);
  };
  const auto add_quad = [&](int a, int b, int c, int d, MannequinPart part) {
    add(a, b, c, part);
    add(a, c, d, part);
  };
  const int rings = static_cast<int>(heights.size());
  for (int ring = 0; ring + 1 < rings; ++ring) {
    const float middle = (heights[static_cast<std::size_t>(ring)] + heights[static_cast<std::size_t>(ring) + 1]) / 2;
    for (int column = 0; column < kColumns; ++column) {
      const int next = (column + 1) % kColumns;
      bool gap = std::abs(middle - kMouthY) < kLipGap && std::abs(column - kColumns / 2) < kColumns / 4;
      if (gap)
        gap = std::abs(plain_point(mean, middle, (column_azimuth(column) + column_azimuth(column + 1)) / 2).x()) <
              kMouthHalfWidth;
      add_quad(ring * kColumns + column, ring * kColumns + next, (ring + 1) * kColumns + next,
               (ring + 1) * kColumns + column, gap ? MannequinPart::kBetweenLips : MannequinPart::kSkin);
    }
  }
  const int pole = rings * kColumns;
  for (int column = 0; column < kColumns; ++column) {
    add(pole - kColumns + column, pole - kColumns + (column + 1) % kColumns, pole, MannequinPart::kSkin);
  }
  grid.skin_vertices = pole + 1;
  int first = grid.skin_vertices;
  for (int side = 0; side < 2; ++side, first += (kEyeRings + 1) * kEyeColumns) {
    for (int ring = 0; ring < kEyeRings; ++ring) {
      for (int column = 0; column < kEyeColumns; ++column) {
        const int a = first + ring * kEyeColumns + column;
        const int b = first + ring * kEyeColumns + (column + 1) % kEyeColumns;
        add_quad(a, b, b + kEyeColumns, a + kEyeColumns, MannequinPart::kEyeball);
      }
    }
  }
  for (int row = 0; row + 1 < kTeethRows; ++row) {
    for (int column = 0; column < kTeethColumns; ++column) {
      const int a = first + row * (kTeethColumns + 1) + column;
      const int below = a + kTeethColumns + 1;
      add_quad(below, below + 1, a + 1, a, MannequinPart::kTeeth);
    }
  }
  grid.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) grid.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return grid;
}

}  // namespace faceprobe::synth
