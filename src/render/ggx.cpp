#include "render/ggx.h"

#include "render/numbers.h"
#include "render/sobol.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::render {
namespace {

constexpr int kSamples = 1024;  // of the returned share: its error is about .001

}  // namespace

Ggx::Ggx(float alpha) : alpha2_(alpha * alpha), alpha_(alpha) {
  for (int i = 0; i < kAngles; ++i) {
    const float cosine = (static_cast<float>(i) + 0.5F) / kAngles;
    const Eigen::Vector3f view(std::sqrt(1 - cosine * cosine), 0, cosine);
    double sum = 0;
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      SobolSampler random(static_cast<std::uint32_t>(i), s);
      const Eigen::Vector3f light = draw_facet(view, random.pair());
      if (light.z() > 0) sum += single(view, light) / facet_density(view, light);
    }
    directional_albedo_[static_cast<std::size_t>(i)] = static_cast<float>(sum / kSamples);
    mean_albedo_ += 2 * cosine * directional_albedo_[static_cast<std::size_t>(i)] / kAngles;
  }
}

float Ggx::directional_albedo(float cosine) const {
  const float x = std::clamp(cosine * kAngles - 0.5F, 0.0F, static_cast<float>(kAngles - 1));
  const int at = std::min(static_cast<int>(x), kAngles - 2);
  const float share = x - static_cast<float>(at);
  return (1 - share) * directional_albedo_[static_cast<std::size_t>(at)] +
         share * directional_albedo_[static_cast<std::size_t>(at) + 1];
}

float Ggx::lambda(float cosine) const {
  const float cos2 = cosine * cosine;
  return 0.5F * (std::sqrt(1 + alpha2_ * std::max(0.0F, 1 - cos2) / cos2) - 1);
}

float Ggx::distribution(const Eigen::Vector3f& half) const {
  // cos^2 (alpha^2 - 1) + 1, without the cancellation near the normal.
  const float slope = half.x() * half.x() + half.y() * half.y() + alpha2_ * half.z() * half.z();
  return alpha2_ / (kPi32 * slope * slope);
}

float Ggx::single(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (view.z() <= 0 || light.z() <= 0) return 0;
  const Eigen::Vector3f half = (view + light).normalized();
  return distribution(half) / ((1 + lambda(view.z()) + lambda(light.z())) * 4 * view.z());
}

float Ggx::value(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (view.z() <= 0 || light.z() <= 0) return 0;
  const float lost = 1 - directional_albedo(view.z());
  const float wide =
      lost * (1 - directional_albedo(light.z())) / (kPi32 * std::max(1e-6F, 1 - mean_albedo_)) * light.z();
  return single(view, light) * (1 + 0.5F * lost / directional_albedo(view.z())) + 0.5F * wide;
}

// How often draw() looks for the light that value() spreads wide.
float Ggx::wide_chance(float cosine) const { return 0.5F * std::clamp(1 - directional_albedo(cosine), 0.0F, 1.0F); }

float Ggx::density(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  if (view.z() <= 0) return 0;
  const float wide = wide_chance(view.z());
  return (1 - wide) * facet_density(view, light) + wide * std::max(0.0F, light.z()) / kPi32;
}

Eigen::Vector3f Ggx::draw(const Eigen::Vector3f& view, const Eigen::Vector2f& random) const {
  const float wide = wide_chance(view.z());
  if (random.x() >= wide)
    return draw_facet(view, {std::min((random.x() - wide) / (1 - wide), 0x1.fffffep-1F), random.y()});
  const float even = random.x() / wide;
  const float radius = std::sqrt(even);
  const float phi = 2 * kPi32 * random.y();
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0F, 1 - even))};
}

float Ggx::facet_density(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const {
  const Eigen::Vector3f half = (view + light).normalized();
  if (half.z() <= 0) return 0;
  return distribution(half) / ((1 + lambda(view.z())) * 4 * view.z());
}

Eigen::Vector3f Ggx::draw_facet(const Eigen::Vector3f& view, const Eigen::Vector2f& random) const {
  const Eigen::Vector3f stretched = Eigen::Vector3f(alpha_ * view.x(), alpha_ * view.y(), view.z()).normalized();
  const float flat2 = stretched.x() * stretched.x() + stretched.y() * stretched.y();
  const Eigen::Vector3f side =
      flat2 > 0 ? Eigen::Vector3f(Eigen::Vector3f(-stretched.y(), stretched.x(), 0) / std::sqrt(flat2))
                : Eigen::Vector3f::UnitX();
  const Eigen::Vector3f other = stretched.cross(side);
  const float radius = std::sqrt(random.x());
  const float phi = 2 * kPi32 * random.y();
  const float a = radius * std::cos(phi);
  const float s = 0.5F * (1 + stretched.z());
  const float b = (1 - s) * std::sqrt(std::max(0.0F, 1 - a * a)) + s * radius * std::sin(phi);
  const Eigen::Vector3f normal = a * side + b * other + std::sqrt(std::max(0.0F, 1 - a * a - b * b)) * stretched;
  const Eigen::Vector3f half =
      Eigen::Vector3f(alpha_ * normal.x(), alpha_ * normal.y(), std::max(0.0F, normal.z())).normalized();
  return 2 * view.dot(half) * half - view;
}

float dielectric_fresnel(float cosine, float eta) {
  const float sine2 = (1 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1) return 1;
  const float refracted = std::sqrt(1 - sine2);
  const float parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  const float across = (cosine - eta * refracted) / (cosine + eta * refracted);
  return 0.5F * (parallel * parallel + across * across);
}

}  // namespace faceprobe::render
