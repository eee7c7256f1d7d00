#include "faceprobe/face/region.h"

#include "face/landmark_sets.h"

#include <Eigen/Core>
#include <cmath>
#include <span>

namespace faceprobe::face {
namespace {

using Point = Eigen::Vector2f;  // on the subject's right half: |x| as x, and y, both in metres

std::vector<Point> ring_points(const CanonicalMesh& mesh, std::span<const int> ring) {
  std::vector<Point> points;
  for (const int vertex : ring) {
    points.emplace_back(-mesh.vertices_m(vertex, 0), mesh.vertices_m(vertex, 1));
  }
  return points;
}

// Even-odd rule.
bool inside(const std::vector<Point>& ring, const Point& p) {
  bool is_inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point& a = ring[i];
    const Point& b = ring[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      is_inside = !is_inside;
    }
  }
  return is_inside;
}

// The nose's right half, closed along the middle line: bridge, side wall, wing, nostril, base.
constexpr std::array<int, 9> kNoseRing = {168, 193, 188, 217, 209, 129, 98, 97, 2};

struct Rings {
  explicit Rings(const CanonicalMesh& mesh)
      : eye(ring_points(mesh, kRightEyeRing)), eyelid(ring_points(mesh, kRightEyelidRing)),
        brow(ring_points(mesh, kRightBrowRing)), outer_lip(ring_points(mesh, kOuterLipRing)),
        inner_lip(ring_points(mesh, kInnerLipRing)), nose(ring_points(mesh, kNoseRing)),
        mouth_corner(ring_points(mesh, std::array{kRightMouthCorner}).front()), nose_base(mesh.vertices_m(2, 1)),
        bridge(mesh.vertices_m(168, 1)) {}

  std::vector<Point> eye, eyelid, brow, outer_lip, inner_lip, nose;
  Point mouth_corner;
  float nose_base, bridge;  // heights
};

// Limits that no landmark marks, in metres on the canonical face.
constexpr float kForeheadFloor = 0.043F;      // height of the brows
constexpr float kGlabellaHalfWidth = 0.013F;  // between the brows the forehead reaches down to the nose
constexpr float kForeheadHalfWidth = 0.066F;  // beyond: temples
constexpr float kEyeSocketFloor = 0.021F;
constexpr float kEyeSocketHalfWidth = 0.054F;
constexpr float kChinHalfWidth = 0.031F;
constexpr float kEarSide = 0.072F;

Region region_at(const Rings& rings, const Point& p) {
  if (inside(rings.eye, p)) return Region::kEyes;
  if (inside(rings.inner_lip, p)) return Region::kMouth;
  if (inside(rings.outer_lip, p)) return Region::kLips;
  if (inside(rings.brow, p)) return Region::kBrows;
  if (inside(rings.nose, p)) return Region::kNose;
  if (inside(rings.eyelid, p)) return Region::kEyelids;

  const float x = p.x();
  const float y = p.y();
  if (y > rings.bridge && x < kGlabellaHalfWidth) return Region::kForehead;
  if (y > kForeheadFloor) return x < kForeheadHalfWidth ? Region::kForehead : Region::kOther;
  if (y > kEyeSocketFloor) return x < kEyeSocketHalfWidth ? Region::kEyelids : Region::kOther;

  const bool over_mouth = y > rings.mouth_corner.y();
  // The fold from the nose's wing to the corner of the mouth.
  const float fold = rings.nose[5].x() + (rings.nose[5].y() - y) / (rings.nose[5].y() - rings.mouth_corner.y()) *
                                             (rings.mouth_corner.x() - rings.nose[5].x());
  if (over_mouth && y < rings.nose_base + 0.004F && x < fold) return Region::kUpperLip;
  if (!over_mouth && x < kChinHalfWidth) return Region::kChin;
  // The jaw lies under a line from below the ear to beside the chin.
  const float jaw_top = -0.030F - 0.6F * (kEarSide - x);
  if (y < jaw_top) return Region::kJaw;
  return x < kEarSide ? Region::kCheeks : Region::kOther;
}

}  // namespace

std::vector<Region> triangle_regions(const CanonicalMesh& mesh) {
  const Rings rings(mesh);
  std::vector<Region> regions;
  regions.reserve(static_cast<std::size_t>(mesh.triangles.rows()));
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::RowVector3f centre =
        (mesh.vertices_m.row(triangle(0)) + mesh.vertices_m.row(triangle(1)) + mesh.vertices_m.row(triangle(2))) / 3.0F;
    regions.push_back(region_at(rings, {std::abs(centre.x()), centre.y()}));
  }
  return regions;
}

}  // namespace faceprobe::face
