#pragma once
// Collects strands.

#include "faceprobe/synth/mesh.h"

#include <span>
#include <vector>

namespace faceprobe::synth {

class StrandList {
 public:
  StrandList(const Reflectance& reflectance, Region region) : reflectance_(reflectance), region_(region) {
    first_.push_back(0);
  }

  // A strand that tapers to `tip` of its radius.
  void add(std::span<const Eigen::Vector3f> points, float radius_m, float tip, float tone) {
    const auto n = static_cast<float>(points.size() - 1);
    float i = 0;
    for (const Eigen::Vector3f& p : points) {
      const float t = i / n;
      points_.emplace_back(p.x(), p.y(), p.z(), radius_m * (1.0F - (1.0F - tip) * t * t));
      i += 1;
    }
    first_.push_back(static_cast<int>(points_.size()));
    tone_.push_back(tone);
  }
  bool empty() const { return tone_.empty(); }
  Strands take() {
    Strands out;
    out.reflectance = reflectance_;
    out.region = region_;
    out.points.resize(static_cast<Eigen::Index>(points_.size()), 4);
    for (std::size_t i = 0; i < points_.size(); ++i)
      out.points.row(static_cast<Eigen::Index>(i)) = points_[i].transpose();
    out.first_point = std::move(first_);
    out.tone = std::move(tone_);
    return out;
  }

 private:
  Reflectance reflectance_;
  Region region_;
  std::vector<Eigen::Vector4f> points_;
  std::vector<int> first_;
  std::vector<float> tone_;
};

}  // namespace faceprobe::synth
