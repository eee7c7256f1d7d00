#include "synth/wardrobe/skin_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::synth {
namespace {

constexpr int kReach = 2;  // cells around a sample that hear of it
constexpr float kFar = std::numeric_limits<float>::max();

}  // namespace

SkinField::SkinField(const Eigen::Vector3f& low, const Eigen::Vector3f& high, float cell_m)
    : low_(low), cell_(cell_m), band_(static_cast<float>(kReach) * cell_m) {
  size_ = ((high - low) / cell_m).array().ceil().cast<int>().max(1).min(400) + 1;
  squared_.assign(static_cast<std::size_t>(size_.prod()), kFar);
  value_.assign(squared_.size(), band_);
}

void SkinField::splat(const Eigen::Vector3f& p, const Eigen::Vector3f& n) {
  const Eigen::Vector3f q = (p - low_) / cell_;
  const Eigen::Vector3i middle = (q.array() + 0.5F).floor().cast<int>();
  const Eigen::Vector3i from = (middle.array() - kReach).max(0);
  const Eigen::Vector3i to = (middle.array() + kReach).min(size_.array() - 1);
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int x = from.x(); x <= to.x(); ++x) {
        const Eigen::Vector3f away = (Eigen::Vector3i(x, y, z).cast<float>() - q) * cell_;
        const float squared = away.squaredNorm();
        const std::size_t i = index(x, y, z);
        if (squared >= squared_[i]) continue;
        squared_[i] = squared;
        // Near the sample the plane is the better measure: samples are not dense.
        const float plane = away.dot(n);
        const float length = std::sqrt(squared);
        const float far = std::clamp(length / cell_ - 1.0F, 0.0F, 1.0F);
        value_[i] = std::clamp((1.0F - far) * plane + far * std::copysign(length, plane), -band_, band_);
      }
    }
  }
}

void SkinField::add(const SurfaceMesh& mesh) {
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3f a = mesh.vertices.row(t(0)).transpose();
    const Eigen::Vector3f b = mesh.vertices.row(t(1)).transpose();
    const Eigen::Vector3f c = mesh.vertices.row(t(2)).transpose();
    const float longest = std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    // Samples at the middles of n^2 small triangles, closer together than cells.
    const int n = std::clamp(static_cast<int>(std::ceil(longest / (1.4F * cell_))), 1, 64);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < 2 * (n - i) - 1; ++j) {
        const float third = j % 2 == 0 ? 1.0F / 3.0F : 2.0F / 3.0F;
        const float u = (static_cast<float>(i) + third) / static_cast<float>(n);
        const float v = (static_cast<float>(j / 2) + third) / static_cast<float>(n);
        const float w = 1.0F - u - v;
        const Eigen::Vector3f normal =
            (w * mesh.normals.row(t(0)) + u * mesh.normals.row(t(1)) + v * mesh.normals.row(t(2))).transpose();
        const float length = normal.norm();
        if (length > 1e-6F) splat(w * a + u * b + v * c, normal / length);
      }
    }
  }
}

// Outside spreads from above; what it does not reach, and no sample either, is inside.
void SkinField::finish() {
  std::vector<std::uint8_t> reached(value_.size(), 0);
  std::vector<Eigen::Vector3i> open;
  for (int z = 0; z < size_.z(); ++z) {
    for (int x = 0; x < size_.x(); ++x) open.emplace_back(x, size_.y() - 1, z);
  }
  for (const Eigen::Vector3i& c : open) reached[index(c.x(), c.y(), c.z())] = 1;
  while (!open.empty()) {
    const Eigen::Vector3i c = open.back();
    open.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Eigen::Vector3i next = c;
        next(axis) += step;
        if (next(axis) < 0 || next(axis) >= size_(axis)) continue;
        const std::size_t i = index(next.x(), next.y(), next.z());
        if (reached[i] != 0 || value_[i] <= 0) continue;
        reached[i] = 1;
        open.push_back(next);
      }
    }
  }
  for (std::size_t i = 0; i < value_.size(); ++i) {
    if (reached[i] == 0 && squared_[i] == kFar) value_[i] = -band_;
  }
}

float SkinField::distance(const Eigen::Vector3f& p, Eigen::Vector3f* gradient) const {
  const Eigen::Array3f q = (p - low_).array() / cell_;
  const Eigen::Array3i c = q.floor().cast<int>();
  if ((c < 0).any() || (c >= size_.array() - 1).any()) {
    if (gradient != nullptr) gradient->setZero();
    return band_;
  }
  const Eigen::Array3f f = q - c.cast<float>();
  float v[2][2][2];
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      const std::size_t i = index(c.x(), c.y() + y, c.z() + z);
      v[z][y][0] = value_[i];
      v[z][y][1] = value_[i + 1];
    }
  }
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const float y00 = mix(v[0][0][0], v[0][0][1], f.x());
  const float y01 = mix(v[0][1][0], v[0][1][1], f.x());
  const float y10 = mix(v[1][0][0], v[1][0][1], f.x());
  const float y11 = mix(v[1][1][0], v[1][1][1], f.x());
  const float z0 = mix(y00, y01, f.y());
  const float z1 = mix(y10, y11, f.y());
  if (gradient != nullptr) {
    const float x0 = mix(v[0][0][1] - v[0][0][0], v[0][1][1] - v[0][1][0], f.y());
    const float x1 = mix(v[1][0][1] - v[1][0][0], v[1][1][1] - v[1][1][0], f.y());
    *gradient = Eigen::Vector3f(mix(x0, x1, f.z()), mix(y01 - y00, y11 - y10, f.z()), z1 - z0) / cell_;
  }
  return mix(z0, z1, f.z());
}

bool SkinField::push_out(Eigen::Vector3f& p, float clearance) const {
  bool moved = false;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector3f gradient;
    const float d = distance(p, &gradient);
    if (d >= clearance) break;
    const float length = gradient.norm();
    if (length < 1e-4F) break;
    p += gradient / length * (clearance - d);
    moved = true;
  }
  return moved;
}

}  // namespace faceprobe::synth
