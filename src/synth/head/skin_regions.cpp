#include "faceprobe/synth/skin_regions.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

namespace faceprobe::synth {
namespace {

using Point = Eigen::Vector2f;  // on half a face: distance from its middle plane, and height
using Ring = std::vector<Point>;

// Even-odd rule.
bool inside(const Ring& ring, const Point& p) {
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

// Height of a polyline that runs inwards or outwards, at distance x; its ends continue level.
float height_at(const Ring& line, float x) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point& a = line[i - 1];
    const Point& b = line[i];
    if ((a.x() - x) * (b.x() - x) <= 0 && a.x() != b.x())
      return a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
  }
  const bool first_is_inner = line.front().x() < line.back().x();
  return (x < line.front().x()) == first_is_inner ? line.front().y() : line.back().y();
}

// The Multi-PIE point on the subject's other half.
constexpr std::array<int, 68> kMirror = {16, 15, 14, 13, 12, 11, 10, 9,  8,  7,  6,  5,  4, 3, 2, 1, 0,  // jaw
                                         26, 25, 24, 23, 22, 21, 20, 19, 18, 17,                         // brows
                                         27, 28, 29, 30, 35, 34, 33, 32, 31,                             // nose
                                         45, 44, 43, 42, 47, 46, 39, 38, 37, 36, 41, 40,                 // eyes
                                         54, 53, 52, 51, 50, 49, 48, 59, 58, 57, 56, 55,                 // outer lips
                                         64, 63, 62, 61, 60, 67, 66, 65};                                // inner lips

// What the landmarks say about half a face. Lengths that no landmark marks are given for a face whose eyes' middles lie 63 mm
// apart, and grow with that distance.
struct Limits {
  explicit Limits(const HeadModel& model) {
    std::array<Eigen::Vector3f, 68> marks;
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = model.neutral.row(model.landmarks[i]).transpose();
    for (const int i : {27, 28, 29, 30, 33, 8, 51, 57}) middle_x += marks[static_cast<std::size_t>(i)].x() / 8.0F;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const Eigen::Vector3f& other = marks[static_cast<std::size_t>(kMirror[i])];
      half[i] = {(std::abs(marks[i].x() - middle_x) + std::abs(other.x() - middle_x)) / 2,
                 (marks[i].y() + other.y()) / 2};
    }
    scale = (half[36].x() + half[39].x()) / 0.063F;
    ear_z = (marks[0].z() + marks[1].z() + marks[15].z() + marks[16].z()) / 4 - 0.012F * scale;

    eye = points({36, 37, 38, 39, 40, 41});
    outer_lip = points({48, 49, 50, 51, 57, 58, 59});
    outer_lip[3].x() = outer_lip[4].x() = -1e-4F;  // the ring is closed behind the middle plane
    jaw_line = points({0, 1, 2, 3, 4, 5, 6, 7, 8});
    jaw_line.back().x() = 0;
    brow_line = points({17, 18, 19, 20, 21});
    for (const Point& p : brow_line) brow.push_back(p + Point(0, 0.0035F * scale));
    brow.front().x() += 0.002F * scale;
    for (std::size_t i = brow_line.size(); i-- > 0;) brow.push_back(brow_line[i] - Point(0, 0.0055F * scale));

    wing = half[31].x() + 0.005F * scale;
    nose_base = half[33].y();
    const float bridge = half[27].y();
    nose = {{-1e-4F, bridge + 0.002F * scale},
            {0.007F * scale, bridge},
            {0.010F * scale, half[28].y()},
            {0.75F * wing, half[29].y()},
            {wing, half[30].y()},
            {wing, nose_base + 0.003F * scale},
            {0.75F * wing, nose_base - 0.003F * scale},
            {-1e-4F, nose_base - 0.003F * scale}};
    eye_middle = (half[36] + half[39]) / 2;
    eye_half_width = (half[36].x() - half[39].x()) / 2;
    mouth_corner = half[48];
    hairline =
        brow_middle() + 0.8F * (brow_middle() - nose_base);  // measured from the brows' middle, not their lower rim
  }

  Ring points(std::initializer_list<int> indices) const {
    Ring ring;
    for (const int i : indices) ring.push_back(half[static_cast<std::size_t>(i)]);
    return ring;
  }
  float brow_middle() const { return half[19].y(); }

  std::array<Point, 68> half;
  float middle_x = 0, scale = 1, ear_z = 0;
  Ring eye, outer_lip, jaw_line, brow_line, brow, nose;
  float wing = 0, nose_base = 0, eye_half_width = 0, hairline = 0;
  Point eye_middle{0, 0}, mouth_corner{0, 0};
};

bool in_eye_socket(const Limits& limits, const Point& p) {
  // Half an ellipse below the lid; above, up to the brow.
  const float x = (p.x() - limits.eye_middle.x()) / (1.5F * limits.eye_half_width);
  const float y = (p.y() - limits.eye_middle.y()) / (0.95F * limits.eye_half_width);
  if (y < 0) return x * x + y * y < 1;
  return std::abs(x) < 1 && p.y() < height_at(limits.brow_line, p.x());
}

Region skin_region(const Limits& limits, const Eigen::Vector3f& position) {
  const Point p(std::abs(position.x() - limits.middle_x), position.y());
  const float x = p.x();
  const float y = p.y();
  const float s = limits.scale;
  if (position.z() < limits.ear_z) return Region::kOther;
  if (inside(limits.eye, p)) return Region::kEyelids;  // the lids' inner side, and what of them lies before the eyeball
  if (inside(limits.outer_lip, p)) return Region::kLips;
  if (inside(limits.brow, p)) return Region::kBrows;
  if (inside(limits.nose, p)) return Region::kNose;
  if (in_eye_socket(limits, p)) return Region::kEyelids;

  const float temple = limits.half[17].x() + 0.008F * s;
  if (y > height_at(limits.brow_line, x) || (y > limits.half[27].y() && x < limits.half[39].x())) {
    return x < temple && y < limits.hairline ? Region::kForehead : Region::kOther;
  }
  const float below_jaw = height_at(limits.jaw_line, x) - y;
  if (below_jaw > 0.010F * s || x > limits.half[0].x()) return Region::kOther;  // neck, ears
  if (y > limits.eye_middle.y())
    return x < limits.eye_middle.x() ? Region::kEyelids : Region::kOther;  // beside the bridge; temples

  const bool over_mouth = y > limits.mouth_corner.y();
  // The fold from the nose's wing to the corner of the mouth.
  const float down = (limits.nose_base - y) / (limits.nose_base - limits.mouth_corner.y());
  const float fold = limits.wing + down * (limits.mouth_corner.x() + 0.002F * s - limits.wing);
  if (over_mouth && y < limits.nose_base && x < fold) return Region::kUpperLip;
  const float chin = 1.2F * limits.mouth_corner.x();
  if (!over_mouth && x < chin) return Region::kChin;
  // The jaw lies under a line from the ear at the height of the nose's base to beside the chin, a little under the mouth.
  const float outer = limits.half[2].x();
  const float inner_y = limits.mouth_corner.y() - 0.010F * s;
  const float jaw_top = inner_y + (x - chin) / (outer - chin) * (limits.nose_base - inner_y);
  return y < jaw_top ? Region::kJaw : Region::kCheeks;
}

}  // namespace

std::vector<Region> regions_from_landmarks(const HeadModel& model) {
  std::vector<Region> regions(static_cast<std::size_t>(model.neutral.rows()), Region::kOther);
  if (model.landmarks.size() == 68) {
    const Limits limits(model);
    for (Eigen::Index v = 0; v < model.neutral.rows(); ++v) {
      regions[static_cast<std::size_t>(v)] = skin_region(limits, model.neutral.row(v).transpose());
    }
  }
  // A vertex that skin shares with another part is skin: the part behind is hidden there.
  std::vector<bool> is_skin(regions.size(), false);
  for (Eigen::Index t = 0; t < model.triangles.rows(); ++t) {
    if (model.triangle_material[static_cast<std::size_t>(t)] != Material::kSkin) continue;
    for (int corner = 0; corner < 3; ++corner) is_skin[static_cast<std::size_t>(model.triangles(t, corner))] = true;
  }
  for (Eigen::Index t = 0; t < model.triangles.rows(); ++t) {
    const Material material = model.triangle_material[static_cast<std::size_t>(t)];
    for (int corner = 0; corner < 3; ++corner) {
      const auto v = static_cast<std::size_t>(model.triangles(t, corner));
      if (!is_skin[v]) regions[v] = material == Material::kEye ? Region::kEyes : Region::kMouth;
    }
  }
  return regions;
}

}  // namespace faceprobe::synth
