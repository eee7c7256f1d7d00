#include "synth/wardrobe/scalp.h"

#include "faceprobe/core/angles.h"
#include "synth/wardrobe/noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace faceprobe::synth {
namespace {

float rad(float degrees) { return static_cast<float>(radians(static_cast<double>(degrees))); }

}  // namespace

Scalp::Scalp(const Anatomy& anatomy, const HairlineShape& shape, std::uint64_t seed)
    : anatomy_(anatomy), shape_(shape), seed_(seed) {
  const float s = anatomy.scale;
  const float brow = anatomy.brow_y();
  const float top = anatomy.skull_centre.y() + anatomy.skull_radii.y();
  const float front = std::min(brow + shape.front_m * s, top - 0.012F * s);
  const float ear = anatomy.ear_top;
  const float lobe = anatomy.ear_bottom;
  const auto azimuth_of = [&](float z) {  // on the side of the head
    const float forward = std::clamp((z - anatomy.skull_centre.z()) / anatomy.skull_radii.z(), -0.95F, 0.95F);
    return std::acos(forward);
  };
  const float front_of_ear = azimuth_of(anatomy.ear_front);
  const float back_of_ear = azimuth_of(anatomy.ear_back);
  const float sideburn = ear - shape.sideburn_m * s;
  line_ = {{{0.0F, front - 0.002F * s},
            {rad(14), front},
            {rad(30), front + shape.recess_m * s},
            {rad(42), front - 0.014F * s + 0.8F * shape.recess_m * s},
            {rad(52), brow + 0.022F * s},
            {front_of_ear - rad(18), brow - 0.002F * s},
            {front_of_ear - rad(13), sideburn + 0.008F * s},
            {front_of_ear - rad(3), sideburn},
            {front_of_ear + rad(4), ear + 0.007F * s},
            {back_of_ear - rad(5), ear + 0.006F * s},
            {back_of_ear + rad(6), 0.6F * ear + 0.4F * lobe},
            {back_of_ear + rad(14), lobe - 0.006F * s - shape.nape_m * s},
            {rad(155), lobe - 0.022F * s - shape.nape_m * s},
            {rad(180), lobe - 0.026F * s - shape.nape_m * s}}};
  for (std::size_t i = 1; i < line_.size(); ++i) {  // an odd head may not turn the line back
    line_[i].azimuth = std::max(line_[i].azimuth, line_[i - 1].azimuth + 0.01F);
  }
  line_.back().azimuth = std::max(line_.back().azimuth, static_cast<float>(kPi) + 0.01F);

  const SurfaceMesh& skin = anatomy.skin;
  vertex_inside_.resize(static_cast<std::size_t>(skin.vertices.rows()));
  for (Eigen::Index v = 0; v < skin.vertices.rows(); ++v) {
    vertex_inside_[static_cast<std::size_t>(v)] = inside(skin.vertices.row(v).transpose());
  }
  for (int t = 0; t < skin.triangles.rows(); ++t) {
    const auto corners = skin.triangles.row(t);
    float most = -1;
    for (const int c : corners) most = std::max(most, vertex_inside_[static_cast<std::size_t>(c)]);
    if (most < -0.004F * s) continue;
    const Eigen::Vector3f a = skin.vertices.row(corners(0)).transpose();
    const Eigen::Vector3f b = skin.vertices.row(corners(1)).transpose();
    const Eigen::Vector3f c = skin.vertices.row(corners(2)).transpose();
    area_ += 0.5F * (b - a).cross(c - a).norm();
    triangles_.push_back(t);
    area_up_to_.push_back(area_);
  }
}

float Scalp::inside(const Eigen::Vector3f& p) const {
  const Anatomy& a = anatomy_;
  const float s = a.scale;
  const Eigen::Vector3f q = (p - a.skull_centre).cwiseQuotient(a.skull_radii);
  const float azimuth = std::atan2(std::abs(q.x()), q.z());
  std::size_t i = 1;
  while (i + 1 < line_.size() && line_[i].azimuth < azimuth) ++i;
  const float span = line_[i].azimuth - line_[i - 1].azimuth;
  const float t = std::clamp((azimuth - line_[i - 1].azimuth) / span, 0.0F, 1.0F);
  const float y = line_[i - 1].y + t * (line_[i].y - line_[i - 1].y);
  // Where the line is steep, a step in height is a smaller step away from it.
  const float reach = std::max(std::hypot(p.x(), p.z() - a.skull_centre.z()), 0.03F * s);
  const float slope = (line_[i].y - line_[i - 1].y) / (span * reach);
  float result = (p.y() - y) / std::sqrt(1.0F + slope * slope);
  // The ear's own surface bears none.
  if (p.y() < a.ear_top + 0.003F * s && std::abs(p.x()) > a.skull_radii.x() + 0.003F * s)
    result = std::min(result, -0.01F * s);
  return result;
}

float Scalp::ragged_inside(const Eigen::Vector3f& p) const {
  const float s = anatomy_.scale;
  return inside(p) +
         shape_.raggedness_m * s * (noise(seed_, p / (0.009F * s)) + 0.7F * noise(seed_ + 7, p / (0.0035F * s)));
}

std::vector<Scalp::Root> Scalp::roots(int count, float feather_m, Random& random) const {
  std::vector<Root> found;
  if (area_ <= 0) return found;
  found.reserve(static_cast<std::size_t>(count));
  const SurfaceMesh& skin = anatomy_.skin;
  for (int tries = 0; tries < 8 * count && static_cast<int>(found.size()) < count; ++tries) {
    const auto at = static_cast<float>(random.uniform()) * area_;
    const auto pick = std::min<std::ptrdiff_t>(std::ranges::upper_bound(area_up_to_, at) - area_up_to_.begin(),
                                               static_cast<std::ptrdiff_t>(triangles_.size()) - 1);
    const auto corners = skin.triangles.row(triangles_[static_cast<std::size_t>(pick)]);
    const float r = std::sqrt(static_cast<float>(random.uniform()));
    const float v = static_cast<float>(random.uniform()) * r;
    const float u = r - v;
    const auto blend = [&](const Eigen::MatrixX3f& m) -> Eigen::Vector3f {
      return ((1.0F - u - v) * m.row(corners(0)) + u * m.row(corners(1)) + v * m.row(corners(2))).transpose();
    };
    const Eigen::Vector3f position = blend(skin.vertices);
    const float keep = static_cast<float>(random.uniform());
    const float depth = ragged_inside(position);
    if (depth <= 0 || keep > 0.15F + 0.85F * smooth_step(0, feather_m, depth)) continue;
    const Eigen::Vector3f normal = blend(skin.normals);
    if (normal.norm() < 1e-3F) continue;
    found.push_back({position, normal.normalized(), depth});
  }
  return found;
}

SurfaceMesh Scalp::cap(float margin_m, float offset_m) const {
  const SurfaceMesh& skin = anatomy_.skin;
  SurfaceMesh out;
  out.material = Material::kCloth;
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector3i> triangles;
  std::map<std::pair<int, int>, int> made;  // along edges (a < b), or at vertices (a, a)
  std::vector<float> depth(vertex_inside_.size());
  for (std::size_t v = 0; v < depth.size(); ++v) {
    const float rough = std::abs(vertex_inside_[v]) < 0.03F
                            ? ragged_inside(skin.vertices.row(static_cast<Eigen::Index>(v)).transpose())
                            : vertex_inside_[v];
    depth[v] = rough - margin_m;
  }
  const auto vertex = [&](int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] = made.try_emplace({a, b}, static_cast<int>(points.size()));
    if (fresh) {
      const float da = depth[static_cast<std::size_t>(a)];
      const float db = depth[static_cast<std::size_t>(b)];
      const float t = a == b ? 0.0F : std::clamp(da / (da - db), 0.0F, 1.0F);
      const Eigen::Vector3f blended = ((1.0F - t) * skin.normals.row(a) + t * skin.normals.row(b)).transpose();
      const Eigen::Vector3f n =
          blended.norm() > 1e-3F ? Eigen::Vector3f(blended.normalized()) : Eigen::Vector3f(0, 1, 0);
      points.emplace_back(((1.0F - t) * skin.vertices.row(a) + t * skin.vertices.row(b)).transpose() + offset_m * n);
      normals.push_back(n);
    }
    return it->second;
  };
  for (const int t : triangles_) {
    const auto c = skin.triangles.row(t);
    int polygon[4];
    int n = 0;
    for (int k = 0; k < 3; ++k) {  // Sutherland and Hodgman's clipping, against depth > 0
      const int a = c(k);
      const int b = c((k + 1) % 3);
      const bool in_a = depth[static_cast<std::size_t>(a)] > 0;
      const bool in_b = depth[static_cast<std::size_t>(b)] > 0;
      if (in_a) polygon[n++] = vertex(a, a);
      if (in_a != in_b) polygon[n++] = vertex(a, b);
    }
    for (int k = 2; k < n; ++k) triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
  }
  out.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  out.normals.resize(out.vertices.rows(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.vertices.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
    out.normals.row(static_cast<Eigen::Index>(i)) = normals[i].transpose();
  }
  out.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    out.triangles.row(static_cast<Eigen::Index>(i)) = triangles[i].transpose();
  out.vertex_region.assign(points.size(), Region::kHair);
  return out;
}

}  // namespace faceprobe::synth
