#include "cycles/quadrature.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"

#include <embree3/rtcore.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace faceprobe::bench {

namespace {

using Weights = Eigen::Matrix<float, kLobeCount, Eigen::Dynamic, Eigen::RowMajor>;
constexpr int kPacket = 16;

class Tracer {
 public:
  explicit Tracer(const synth::SurfaceMesh& mesh)
      : device_(rtcNewDevice(nullptr), rtcReleaseDevice), scene_(rtcNewScene(device_.get()), rtcReleaseScene) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), static_cast<std::size_t>(mesh.vertices.rows())));
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned),
                                                                   static_cast<std::size_t>(mesh.triangles.rows())));
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
      for (int k = 0; k < 3; ++k) points[3 * i + k] = mesh.vertices(i, k);
    }
    for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i) {
      for (int k = 0; k < 3; ++k) corners[3 * i + k] = static_cast<unsigned>(mesh.triangles(i, k));
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
  }

  // Triangle, or -1, with barycentric coordinates of its second and third corner.
  int first_hit(const Eigen::Vector3f& direction, float& u, float& v) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.dir_x = direction.x();
    ray.ray.dir_y = direction.y();
    ray.ray.dir_z = direction.z();
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return -1;
    u = ray.hit.u;
    v = ray.hit.v;
    return static_cast<int>(ray.hit.primID);
  }

  // free[i] = 1 where nothing lies in that direction.
  void free_directions(const Eigen::Vector3f& origin, const Eigen::MatrixX3f& directions, const std::vector<int>& which,
                       std::vector<std::uint8_t>& free) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const int count = static_cast<int>(which.size());
    for (int first = 0; first < count; first += kPacket) {
      alignas(64) RTCRay16 rays;
      alignas(64) int valid[kPacket];
      const int last = std::min(first + kPacket, count);
      for (int i = 0; i < kPacket; ++i) {
        valid[i] = first + i < last ? -1 : 0;
        const int texel = which[static_cast<std::size_t>(std::min(first + i, last - 1))];
        rays.org_x[i] = origin.x();
        rays.org_y[i] = origin.y();
        rays.org_z[i] = origin.z();
        rays.dir_x[i] = directions(texel, 0);
        rays.dir_y[i] = directions(texel, 1);
        rays.dir_z[i] = directions(texel, 2);
        rays.tnear[i] = 0.0F;
        rays.tfar[i] = std::numeric_limits<float>::infinity();
        rays.time[i] = 0.0F;
        rays.mask[i] = ~0U;
        rays.flags[i] = 0;
      }
      rtcOccluded16(valid, scene_.get(), &context, &rays);
      for (int i = 0; first + i < last; ++i) free[static_cast<std::size_t>(first + i)] = rays.tfar[i] >= 0.0F ? 1 : 0;
    }
  }

 private:
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, void (*)(RTCDevice)> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, void (*)(RTCScene)> scene_;
};

struct Point {
  Eigen::Vector3f position;  // lifted to the smooth surface, and a hair above it
  Eigen::Vector3f normal;
  Eigen::Vector3f view;
};

bool find_point(const Tracer& tracer, const synth::SurfaceMesh& mesh, const Eigen::Vector3f& ray, Point& out) {
  float u = 0;
  float v = 0;
  const int triangle = tracer.first_hit(ray, u, v);
  if (triangle < 0) return false;
  const std::array<float, 3> weight = {1 - u - v, u, v};
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  std::array<Eigen::Vector3f, 3> corner;
  std::array<Eigen::Vector3f, 3> corner_normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const int vertex = mesh.triangles(triangle, static_cast<int>(k));
    corner[k] = mesh.vertices.row(vertex).transpose();
    corner_normal[k] = mesh.normals.row(vertex).transpose();
    position += weight[k] * corner[k];
    normal += weight[k] * corner_normal[k];
  }
  // Shadow rays start on the surface that the normals describe, not in the flat triangle below it, or facets would show in
  // grazing light (Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021). Cycles does the same where light grazes.
  Eigen::Vector3f lift = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    lift -= weight[k] * std::min(0.0F, (position - corner[k]).dot(corner_normal[k])) * corner_normal[k];
  }
  Eigen::Vector3f flat = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  if (flat.dot(ray) > 0) flat = -flat;
  out.normal = normal.normalized();
  out.view = -ray;
  out.position = position + lift + flat * 2e-5F;
  return true;
}

}  // namespace

float beckmann_smith_lobe(const Eigen::Vector3f& normal, const Eigen::Vector3f& view, const Eigen::Vector3f& light,
                          float alpha) {
  const float n_l = normal.dot(light);
  const float n_v = normal.dot(view);
  if (n_l <= 0 || n_v <= 0) return 0;
  const float n_h = std::min(1.0F, normal.dot((view + light).normalized()));
  // Rational fit to Smith's term: Walter et al. 2007, below their Eq. 27.
  const auto smith = [alpha](float cosine) {
    const float a = cosine / (alpha * std::sqrt(std::max(1e-12F, 1 - cosine * cosine)));
    return a < 1.6F ? (3.535F * a + 2.181F * a * a) / (1 + 2.276F * a + 2.577F * a * a) : 1.0F;
  };
  return beckmann(n_h, alpha) / static_cast<float>(kPi) * smith(n_l) * smith(n_v) / (4 * n_v);
}

Quadrature integrate_pixels(const synth::SurfaceMesh& mesh_cam, const synth::PinholeCamera& camera,
                            const std::vector<int>& pixels, std::span<const EnvMap> maps,
                            const QuadratureOptions& options) {
  const int width = maps.front().width();
  const int height = maps.front().height();
  const int texels = width * height;
  Eigen::MatrixX3f directions(texels, 3);
  Eigen::MatrixXf energy(texels, 3 * static_cast<int>(maps.size()));  // radiance x solid angle
  for (std::size_t m = 0; m < maps.size(); ++m) {
    if (maps[m].width() != width) throw std::invalid_argument("integrate_pixels: maps of one size");
    for (int y = 0; y < height; ++y) {
      const auto solid_angle = static_cast<float>(texel_solid_angle(y, width, height));
      for (int x = 0; x < width; ++x) {
        directions.row(y * width + x) = maps[m].direction(x, y).transpose();
        for (int c = 0; c < 3; ++c)
          energy(y * width + x, 3 * static_cast<int>(m) + c) = solid_angle * maps[m].radiance()(x, y, c);
      }
    }
  }
  const Tracer tracer(mesh_cam);
  const int count = static_cast<int>(pixels.size());
  Quadrature out;
  for (auto& layer : out.radiance) layer.setZero(count, energy.cols());

  const int side = options.samples_per_side;
  parallel_for(count, options.threads, [&](int first, int last) {
    std::vector<int> facing;
    std::vector<std::uint8_t> free(static_cast<std::size_t>(texels));
    Weights weights;
    for (int p = first; p < last; ++p) {
      const int pixel = pixels[static_cast<std::size_t>(p)];
      weights.setZero(kLobeCount, texels);
      for (int s = 0; s < side * side; ++s) {
        const float x = static_cast<float>(pixel % camera.width_px) +
                        (static_cast<float>(s % side) + 0.5F) / static_cast<float>(side);
        const float y = static_cast<float>(pixel / camera.width_px) +
                        (static_cast<float>(s / side) + 0.5F) / static_cast<float>(side);
        const Eigen::Vector3f ray = Eigen::Vector3f((x - camera.centre_px.x()) / camera.focal_px,
                                                    -(y - camera.centre_px.y()) / camera.focal_px, -1)
                                        .normalized();
        Point point;
        if (!find_point(tracer, mesh_cam, ray, point)) continue;
        facing.clear();
        for (int t = 0; t < texels; ++t) {
          if (directions.row(t).dot(point.normal) > 0) facing.push_back(t);
        }
        tracer.free_directions(point.position, directions, facing, free);
        for (std::size_t i = 0; i < facing.size(); ++i) {
          if (!free[i]) continue;
          const Eigen::Vector3f light = directions.row(facing[i]).transpose();
          const float share = 1.0F / static_cast<float>(side * side);
          weights(0, facing[i]) += share * light.dot(point.normal) / static_cast<float>(kPi);
          const Microfacet skin{.roughness = options.roughness, .specular_albedo = 1.0F, .f0 = kSkinF0};
          const Microfacet metal{.roughness = options.roughness, .specular_albedo = 0.25F, .f0 = 1.0F};
          weights(1, facing[i]) += share * specular_lobe(point.normal, point.view, light, skin);
          weights(2, facing[i]) += share * specular_lobe(point.normal, point.view, light, metal);
          weights(3, facing[i]) += share * beckmann_smith_lobe(point.normal, point.view, light, options.roughness);
        }
      }
      const Eigen::MatrixXf sums = weights * energy;
      for (int lobe = 0; lobe < kLobeCount; ++lobe)
        out.radiance[static_cast<std::size_t>(lobe)].row(p) = sums.row(lobe);
    }
  });
  return out;
}

}  // namespace faceprobe::bench
