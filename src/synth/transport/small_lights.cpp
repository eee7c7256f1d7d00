#include "synth/transport/small_lights.h"

#include "synth/transport/lobe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace faceprobe::synth {
namespace {

// One ray's worth of light at each point of a chunk.
struct Beam {
  Eigen::MatrixX3f to_light;  // #points x 3, unit length
  Eigen::ArrayXf power;  // irradiance on a surface that faces it, for radiance (or, for distant light, irradiance) 1
  Eigen::ArrayXf far;    // distance to the light
};

Eigen::ArrayXf cosines(const Eigen::MatrixX3f& normal, int first, const Beam& beam) {
  return normal.middleRows(first, beam.to_light.rows()).cwiseProduct(beam.to_light).rowwise().sum().array();
}

// The share of a beam that reaches each point: 0 or 1 from one ray each; no ray where `wanted` says so.
Eigen::ArrayXf trace(const Scene& scene, const Eigen::MatrixX3f& origin, int first, const Beam& beam,
                     const Eigen::VectorXf* near, const std::function<bool(int)>& wanted) {
  const auto count = static_cast<int>(beam.to_light.rows());
  std::vector<ShadowRay> rays;
  std::vector<int> point;
  rays.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    if (!wanted(i)) continue;
    const float begin = near != nullptr ? (*near)(first + i) : 0.0F;
    rays.push_back(
        {origin.row(first + i).transpose(), beam.to_light.row(i).transpose(), begin, std::max(begin, beam.far(i))});
    point.push_back(i);
  }
  std::vector<std::uint8_t> free(rays.size());
  scene.visible(rays, free.data());
  Eigen::ArrayXf share = Eigen::ArrayXf::Zero(count);
  for (std::size_t k = 0; k < rays.size(); ++k) share(point[k]) = free[k];
  return share;
}

// Four more rays from over the pixel for each fragment whose vertices disagree.
void smooth_edges(const Scene& scene, const SurfacePoints& points, int first, const Beam& beam,
                  const Eigen::ArrayXf& n_l, const std::uint8_t* lit, Eigen::ArrayXf& share) {
  constexpr float kPlaces[4][2] = {{-0.375F, -0.125F}, {0.125F, -0.375F}, {0.375F, 0.125F}, {-0.125F, 0.375F}};
  constexpr float kLeastNormalView = 0.25F;  // pixels are not drawn out longer than four times along a slope
  std::vector<ShadowRay> rays;
  std::vector<int> point;
  for (int i = 0; i < n_l.size(); ++i) {
    const int p = first + i;
    if (n_l(i) <= 0 || points.pixel_m(p) <= 0) continue;
    const int sum = (lit[points.row(p, 0)] & kLit) + (lit[points.row(p, 1)] & kLit) + (lit[points.row(p, 2)] & kLit);
    if (sum == 3 * static_cast<int>(share(i))) continue;
    const Eigen::Vector3f normal = points.normal.row(p).transpose();
    const Eigen::Vector3f view = points.view.row(p).transpose();
    const Eigen::Vector3f side = normal.cross(view);
    const Eigen::Vector3f across =
        side.squaredNorm() > 1e-6F ? Eigen::Vector3f(side.normalized()) : normal.unitOrthogonal();
    const Eigen::Vector3f along = normal.cross(across) / std::max(kLeastNormalView, normal.dot(view));
    for (const auto& place : kPlaces) {
      const Eigen::Vector3f offset = points.pixel_m(p) * (place[0] * across + place[1] * along);
      rays.push_back({points.origin.row(p).transpose() + offset, beam.to_light.row(i).transpose()});
      point.push_back(i);
    }
  }
  std::vector<std::uint8_t> free(rays.size());
  scene.visible(rays, free.data());
  for (std::size_t k = 0; k < rays.size(); k += 4) {
    share(point[k]) = (share(point[k]) + static_cast<float>(free[k] + free[k + 1] + free[k + 2] + free[k + 3])) / 5.0F;
  }
}

void add_diffuse(const SurfacePoints& points, int first, const Beam& beam, const Eigen::ArrayXf& n_l,
                 const Eigen::ArrayXf& share, const Eigen::Vector3f& colour, Eigen::MatrixX3f& shading) {
  const Eigen::ArrayXf diffuse = n_l.max(0.0F) * beam.power * share / static_cast<float>(kPi);
  for (int i = 0; i < diffuse.size(); ++i) {
    if (diffuse(i) > 0)
      shading.row(points.index[static_cast<std::size_t>(first + i)]) += diffuse(i) * colour.transpose();
  }
}

void add_specular(const SurfacePoints& points, int first, const Beam& beam, const Eigen::ArrayXf& n_l,
                  const Eigen::ArrayXf& share, const Eigen::Vector3f& colour, Eigen::MatrixX3f& specular) {
  const Eigen::Index count = n_l.size();
  Eigen::ArrayXf n_h(count);
  Eigen::ArrayXf v_h(count);
  Eigen::ArrayXf lobe(count);
  lobe_values(n_l, cosines(points.view, first, beam), points.n_v.segment(first, count),
              points.roughness.segment(first, count), points.f0.segment(first, count), n_h, v_h, lobe);
  lobe *= beam.power * share;
  for (int i = 0; i < count; ++i) {
    if (share(i) <= 0 || points.n_v(first + i) <= 0) continue;
    specular.row(points.index[static_cast<std::size_t>(first + i)]) += lobe(i) * colour.transpose();
  }
}

void add_beam(const Scene& scene, const HairPoints& hairs, const Beam& beam, const Eigen::Vector3f& colour,
              Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular) {
  const Eigen::ArrayXf share = trace(scene, hairs.origin, 0, beam, &hairs.near,
                                     [&](int p) { return hairs.traced[static_cast<std::size_t>(p)] != 0; });
  Eigen::ArrayXf diffuse;
  Eigen::ArrayXf lobe;
  for (int p = 0; p < hairs.count(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    float mean = 0;
    float count = 0;
    for (int k = hairs.first_near[i]; k < hairs.first_near[i + 1]; ++k) {
      const auto other = static_cast<std::size_t>(hairs.near_point[static_cast<std::size_t>(k)]);
      if (hairs.traced[other] == 0) continue;
      mean += share(static_cast<Eigen::Index>(other));
      ++count;
    }
    if (mean <= 0) continue;
    mean *= beam.power(p) / count;
    hair_values(hairs.strand[i], beam.to_light.row(p), diffuse, lobe);
    shading.row(hairs.index[i]) += mean * diffuse(0) * colour.transpose();
    specular.row(hairs.index[i]) += mean * lobe(0) * colour.transpose();
  }
}

Beam distant_beam(const DistantLight& light, int count) {
  return {light.direction.transpose().replicate(count, 1), Eigen::ArrayXf::Ones(count),
          Eigen::ArrayXf::Constant(count, std::numeric_limits<float>::infinity())};
}

// Direction k of n, spread evenly over the cone in which a point sees the lamp: a spiral, whose points share the solid angle.
Beam near_beam(const NearLight& light, const Eigen::MatrixX3f& origins, int first, int count, int k, int n) {
  Beam beam{Eigen::MatrixX3f(count, 3), Eigen::ArrayXf(count), Eigen::ArrayXf(count)};
  constexpr float kGoldenAngle = 2.39996323F;
  const float along = (static_cast<float>(k) + 0.5F) / static_cast<float>(n);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f to_centre = light.position - origins.row(first + i).transpose();
    const float distance =
        std::max(to_centre.norm(), 1.0001F * light.radius);  // a point inside the lamp counts as on it
    const Eigen::Vector3f axis = to_centre.normalized();
    const float sine2 = light.radius * light.radius / (distance * distance);
    const float cap =
        sine2 / (1.0F + std::sqrt(1.0F - sine2));  // 1 - cosine of the cone's half angle, without cancellation
    if (n == 1) {
      beam.to_light.row(i) = axis.transpose();
      beam.power(i) = static_cast<float>(kPi) * sine2;
      beam.far(i) = distance - light.radius;
      continue;
    }
    const float height = 1.0F - along * cap;
    const float radius = std::sqrt(std::max(0.0F, along * cap * (2.0F - along * cap)));
    const float angle = kGoldenAngle * static_cast<float>(k);
    const Eigen::Vector3f side = axis.unitOrthogonal();
    const Eigen::Vector3f direction =
        height * axis + radius * (std::cos(angle) * side + std::sin(angle) * axis.cross(side));
    beam.to_light.row(i) = direction.normalized().transpose();
    beam.power(i) = 2.0F * static_cast<float>(kPi) * cap / static_cast<float>(n);
    const float inside = sine2 - radius * radius;  // half the chord through the lamp, squared, over distance squared
    beam.far(i) = distance * (height - std::sqrt(std::max(0.0F, inside)));
  }
  return beam;
}

}  // namespace

void add_distant(const Scene& scene, const SurfacePoints& vertices, int first, int count, const DistantLight& light,
                 const KnownSky& sky, Eigen::MatrixX3f& shading, std::uint8_t* lit) {
  const Beam beam = distant_beam(light, count);
  const Eigen::ArrayXf n_l = cosines(vertices.normal, first, beam);
  std::uint8_t* seen = lit + first;  // vertices are in the order of their rows
  for (int i = 0; i < count; ++i) seen[i] = n_l(i) > 0 ? sky.at(first + i) : std::uint8_t{kDark};
  const Eigen::ArrayXf traced = trace(scene, vertices.origin, first, beam, nullptr,
                                      [&](int i) { return n_l(i) > 0 && (seen[i] & kCertain) == 0; });
  Eigen::ArrayXf share(count);
  for (int i = 0; i < count; ++i) {
    if (traced(i) > 0) seen[i] |= kLit;
    share(i) = static_cast<float>(seen[i] & kLit);
  }
  add_diffuse(vertices, first, beam, n_l, share, light.irradiance, shading);
}

void add_near(const Scene& scene, const SurfacePoints& vertices, int first, int count, const NearLight& light,
              Eigen::MatrixX3f& shading) {
  const Beam beam = near_beam(light, vertices.origin, first, count, 0, 1);
  const Eigen::ArrayXf n_l = cosines(vertices.normal, first, beam);
  const Eigen::ArrayXf share = trace(scene, vertices.origin, first, beam, nullptr, [&](int i) { return n_l(i) > 0; });
  add_diffuse(vertices, first, beam, n_l, share, light.radiance, shading);
}

void add_distant(const Scene& scene, const SurfacePoints& fragments, int first, int count, const DistantLight& light,
                 const std::uint8_t* lit, Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular) {
  const Beam beam = distant_beam(light, count);
  const Eigen::ArrayXf n_l = cosines(fragments.normal, first, beam);
  const Eigen::ArrayXf lobe_n_l = cosines(fragments.lobe_normal, first, beam);
  const auto known = [&](int i) -> std::uint8_t {
    const int p = first + i;
    const std::uint8_t seen = lit[fragments.row(p, 0)];
    const bool agree = seen == lit[fragments.row(p, 1)] && seen == lit[fragments.row(p, 2)];
    return agree && (seen & kCertain) != 0 ? seen : std::uint8_t{0};
  };
  Eigen::ArrayXf share = trace(scene, fragments.origin, first, beam, nullptr,
                               [&](int i) { return (n_l(i) > 0 || lobe_n_l(i) > 0) && (known(i) & kCertain) == 0; });
  for (int i = 0; i < count; ++i) {
    if ((known(i) & kLit) != 0) share(i) = 1.0F;
  }
  smooth_edges(scene, fragments, first, beam, n_l, lit, share);
  add_diffuse(fragments, first, beam, n_l, share, light.irradiance, shading);
  add_specular(fragments, first, beam, lobe_n_l, share, light.irradiance, specular);
}

void add_near(const Scene& scene, const SurfacePoints& fragments, int first, int count, const NearLight& light,
              int samples, Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular) {
  for (int k = 0; k < samples; ++k) {
    const Beam beam = near_beam(light, fragments.origin, first, count, k, samples);
    const Eigen::ArrayXf n_l = cosines(fragments.normal, first, beam);
    const Eigen::ArrayXf lobe_n_l = cosines(fragments.lobe_normal, first, beam);
    const Eigen::ArrayXf share =
        trace(scene, fragments.origin, first, beam, nullptr, [&](int i) { return n_l(i) > 0 || lobe_n_l(i) > 0; });
    add_diffuse(fragments, first, beam, n_l, share, light.radiance, shading);
    add_specular(fragments, first, beam, lobe_n_l, share, light.radiance, specular);
  }
}

void add_distant(const Scene& scene, const HairPoints& hairs, const DistantLight& light, Eigen::MatrixX3f& shading,
                 Eigen::MatrixX3f& specular) {
  add_beam(scene, hairs, distant_beam(light, hairs.count()), light.irradiance, shading, specular);
}

void add_near(const Scene& scene, const HairPoints& hairs, const NearLight& light, int samples,
              Eigen::MatrixX3f& shading, Eigen::MatrixX3f& specular) {
  for (int k = 0; k < samples; ++k) {
    add_beam(scene, hairs, near_beam(light, hairs.origin, 0, hairs.count(), k, samples), light.radiance, shading,
             specular);
  }
}

}  // namespace faceprobe::synth
