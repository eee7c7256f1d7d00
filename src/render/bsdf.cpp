#include "render/bsdf.h"

#include "faceprobe/core/microfacet.h"
#include "render/numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr float kGrazing = 1e-4F;  // least cosine: rounding turns normals away from the viewer

// Two directions across a unit vector (Duff et al. 2017).
struct Frame {
  Eigen::Vector3f x, y, z;

  explicit Frame(const Eigen::Vector3f& normal) : z(normal) {
    const float sign = std::copysign(1.0F, z.z());
    const float a = -1 / (sign + z.z());
    const float b = z.x() * z.y() * a;
    x = {1 + sign * z.x() * z.x() * a, sign * b, -sign * z.x()};
    y = {b, sign + z.y() * z.y() * a, -z.y()};
  }
  Eigen::Vector3f local(const Eigen::Vector3f& v) const { return {v.dot(x), v.dot(y), v.dot(z)}; }
  Eigen::Vector3f world(const Eigen::Vector3f& v) const { return v.x() * x + v.y() * y + v.z() * z; }
};

Eigen::Vector3f local_view(const Frame& frame, const Eigen::Vector3f& view) {
  Eigen::Vector3f local = frame.local(view);
  if (local.z() < kGrazing) {
    local.z() = kGrazing;
    local.normalize();
  }
  return local;
}

Eigen::Vector3f mirrored(const Eigen::Vector3f& view, const Eigen::Vector3f& normal) {
  return (2 * view.dot(normal) * normal - view).normalized();
}

}  // namespace

Finish::Finish(Material wanted) : material(std::move(wanted)) {
  const bool has_lobe = material.kind == MaterialKind::kMetal || material.kind == MaterialKind::kPlastic;
  if (has_lobe && material.roughness >= kSmooth) lobe = std::make_unique<Ggx>(material.roughness * material.roughness);
}

Eigen::Vector3f draw_cosine(const Eigen::Vector3f& normal, const Eigen::Vector2f& random) {
  const float radius = std::sqrt(random.x());
  const float phi = 2 * kPi32 * random.y();
  return Frame(normal).world({radius * std::cos(phi), radius * std::sin(phi), std::sqrt(std::max(0.0F, 1 - random.x()))});
}

bool Bsdf::has_halves() const {
  const MaterialKind kind = finish->material.kind;
  return kind == MaterialKind::kGlass || (kind == MaterialKind::kPlastic && finish->lobe == nullptr);
}

bool Bsdf::only_picks_directions() const {
  if (half == Half::kMirrored) return true;
  const MaterialKind kind = finish->material.kind;
  return kind == MaterialKind::kGlass || (kind == MaterialKind::kMetal && finish->lobe == nullptr);
}

float Bsdf::coat() const { return dielectric_fresnel(std::max(kGrazing, normal.dot(view)), finish->material.ior); }

float Bsdf::chance_of_coat() const {
  if (half != Half::kBoth) return half == Half::kMirrored ? 1.0F : 0.0F;
  const float mirrored_share = coat();
  const float below = (1 - mirrored_share) * colour.mean();
  return mirrored_share / std::max(1e-6F, mirrored_share + below);
}

Eigen::Vector3f Bsdf::value(const Eigen::Vector3f& light) const {
  const float cosine = normal.dot(light);
  if (cosine <= 0 || only_picks_directions()) return Eigen::Vector3f::Zero();
  if (finish->material.kind == MaterialKind::kDiffuse) return cosine / kPi32 * colour;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const bool plastic = finish->material.kind == MaterialKind::kPlastic;
  const float share = plastic ? coat() : 1;
  if (plastic) sum = (1 - share) * cosine / kPi32 * colour;
  if (finish->lobe) {
    const Frame frame(normal);
    const float lobe = finish->lobe->value(local_view(frame, view), frame.local(light));
    if (plastic) {
      sum.array() += share * lobe;
    } else {
      const float half_cosine = std::clamp((view + light).normalized().dot(view), 0.0F, 1.0F);
      for (int c = 0; c < 3; ++c) sum[c] += lobe * schlick_fresnel(half_cosine, colour[c]);
    }
  }
  return sum;
}

float Bsdf::density(const Eigen::Vector3f& light) const {
  const float cosine = normal.dot(light);
  if (cosine <= 0 || only_picks_directions()) return 0;
  if (finish->material.kind == MaterialKind::kDiffuse) return cosine / kPi32;
  const float chance = finish->material.kind == MaterialKind::kPlastic ? chance_of_coat() : 1;
  float sum = (1 - chance) * cosine / kPi32;
  if (finish->lobe) {
    const Frame frame(normal);
    sum += chance * finish->lobe->density(local_view(frame, view), frame.local(light));
  }
  return sum;
}

Bsdf::Draw Bsdf::from_lobe(const Eigen::Vector2f& random) const {
  const Frame frame(normal);
  Draw out{frame.world(finish->lobe->draw(local_view(frame, view), random))};
  out.density = density(out.light);
  if (out.density > 0) out.weight = value(out.light) / out.density;
  return out;
}

Bsdf::Draw Bsdf::glass(float choice) const {
  const float cosine = std::clamp(normal.dot(view), 0.0F, 1.0F);
  const float eta = inside ? 1 / finish->material.ior : finish->material.ior;
  const float fresnel = dielectric_fresnel(cosine, eta);
  if (half == Half::kMirrored) return {mirrored(view, normal), Eigen::Vector3f::Constant(fresnel), 0};
  const float chance = half == Half::kRest ? 0 : fresnel;
  if (choice < chance) return {mirrored(view, normal), Eigen::Vector3f::Ones(), 0};
  // Snell. Radiance that is squeezed on the way in spreads again on the way out, so it is not scaled.
  const float refracted = std::sqrt(std::max(0.0F, 1 - (1 - cosine * cosine) / (eta * eta)));
  const Eigen::Vector3f light = ((cosine / eta - refracted) * normal - view / eta).normalized();
  return {light, (1 - fresnel) / (1 - chance) * colour, 0};
}

Bsdf::Draw Bsdf::base(const Eigen::Vector2f& random) const {
  Draw out{draw_cosine(normal, random)};
  out.density = density(out.light);
  if (out.density > 0) out.weight = value(out.light) / out.density;
  return out;
}

Bsdf::Draw Bsdf::draw(float choice, const Eigen::Vector2f& random) const {
  const Material& material = finish->material;
  if (material.kind == MaterialKind::kGlass) return glass(choice);
  if (material.kind == MaterialKind::kMetal) {
    if (finish->lobe) return from_lobe(random);
    Draw out{mirrored(view, normal)};
    for (int c = 0; c < 3; ++c) out.weight[c] = schlick_fresnel(std::max(0.0F, normal.dot(view)), colour[c]);
    return out;
  }
  const float chance = material.kind == MaterialKind::kPlastic ? chance_of_coat() : 0;
  if (choice < chance) {
    if (finish->lobe) return from_lobe(random);
    return {mirrored(view, normal), Eigen::Vector3f::Constant(coat() / chance), 0};
  }
  return base(random);
}

}  // namespace faceprobe::render
