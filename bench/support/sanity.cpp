#include "support/sanity.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace faceprobe::bench {

namespace {

class Checker {
 public:
  explicit Checker(std::vector<std::string>& broken) : broken_(broken) {}
  void prefix(std::string text) { prefix_ = std::move(text); }
  void check(const std::string& part, bool sound) {
    if (!sound) broken_.push_back(prefix_ + part);
  }
  void range(const std::string& part, std::span<const float> values, float low, float high = INFINITY) {
    check(part,
          std::all_of(values.begin(), values.end(), [&](float v) { return std::isfinite(v) && v >= low && v <= high; }));
  }

 private:
  std::vector<std::string>& broken_;
  std::string prefix_;
};

void check_light(const pipeline::LightResult& result, Checker& checker) {
  checker.range("environment", result.environment.radiance().values(), 0);
  checker.range("confidence", result.confidence.radiance().values(), 0, 1);
  checker.check("light cells", result.light.radiance.allFinite() && result.light.radiance.minCoeff() >= 0);
  checker.check("ambient", result.light.ambient.allFinite());
  checker.check("highlight gain", std::isfinite(result.light.highlight_gain) && std::isfinite(result.light.leak));
  checker.check("SH", result.sh.allFinite());
  for (const lighting::MainLight& light : result.lights) {
    checker.check("main light direction", std::abs(light.direction.norm() - 1) < 1e-3);
    checker.check("main light colour", light.colour.allFinite() && light.colour.minCoeff() >= 0);
    checker.check("main light strength", std::isfinite(light.irradiance) && std::isfinite(light.peak_radiance) &&
                                             std::isfinite(light.solid_angle_sr) && light.share >= 0 &&
                                             light.share <= 1);
  }
}

}  // namespace

std::vector<std::string> broken_parts(const pipeline::Estimate& estimate) {
  std::vector<std::string> broken;
  Checker checker(broken);
  // Separation may leave rounding errors under zero.
  constexpr float kRounding = -1e-5F;
  for (std::size_t i = 0; i < estimate.faces.size(); ++i) {
    const pipeline::FaceEstimate& face = estimate.faces[i];
    checker.prefix("face " + std::to_string(i + 1) + ": ");
    check_light(face, checker);
    checker.range("highlight layer", face.layers.highlight.values(), kRounding);
    checker.range("diffuse layer", face.layers.diffuse.values(), kRounding);
    checker.range("albedo", face.albedo.values(), kRounding);
    checker.range("shading", face.shading.values(), kRounding);
    checker.check("light colour", face.light_colour.allFinite() && face.light_colour.minCoeff() > 0);
    checker.check("landmarks", face.face.landmarks_px.allFinite() && face.face.vertices_cam_m.allFinite());
    checker.check("pose", face.face.camera_from_face.matrix().allFinite());
  }
  if (estimate.joint) {
    checker.prefix("joint: ");
    check_light(*estimate.joint, checker);
  }
  return broken;
}

}  // namespace faceprobe::bench
