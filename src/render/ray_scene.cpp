#include "render/ray_scene.h"

#include "faceprobe/core/error.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kLeastViewCosine = 0.01F;

struct Releaser {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

RTCGeometry geometry_of(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto vertices = static_cast<std::size_t>(mesh.vertices.rows());
  const auto triangles = static_cast<std::size_t>(mesh.triangles.rows());
  auto* position = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
  auto* corner = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles));
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    for (int k = 0; k < 3; ++k) *position++ = mesh.vertices(i, k);
  }
  for (Eigen::Index i = 0; i < mesh.triangles.rows(); ++i) {
    for (int k = 0; k < 3; ++k) *corner++ = static_cast<unsigned>(mesh.triangles(i, k));
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

// Bilinear, repeated; v up.
Eigen::Vector3f texel(const Image& texture, const Eigen::Vector2f& uv) {
  const float x = (uv.x() - std::floor(uv.x())) * static_cast<float>(texture.width()) - 0.5F;
  const float y = (1 - (uv.y() - std::floor(uv.y()))) * static_cast<float>(texture.height()) - 0.5F;
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const auto at = [&](int i, int j) -> Eigen::Vector3f {
    i = (i + texture.width()) % texture.width();
    j = (j + texture.height()) % texture.height();
    return Eigen::Map<const Eigen::Vector3f>(texture.pixel(i, j));
  };
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
         fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
}

// A smooth normal that mirrors the viewer into the surface, where only a black rim would be, is bent until it mirrors along it, as Cycles does.
Eigen::Vector3f mirroring_outwards(const Eigen::Vector3f& normal, const Eigen::Vector3f& face, const Eigen::Vector3f& view) {
  constexpr float kLeastHeight = 0.01F;
  const Eigen::Vector3f mirrored = 2 * normal.dot(view) * normal - view;
  const float least = std::min(0.9F * face.dot(view), kLeastHeight);
  const float height = mirrored.dot(face);
  if (height >= least) return normal;
  return ((mirrored + (least - height) * face).normalized() + view).normalized();
}

Material ground_material(const Ground& ground) {
  return {.name = "ground", .kind = MaterialKind::kDiffuse, .colour = ground.albedo};
}

}  // namespace

struct RayScene::State {
  Model model;
  std::optional<Ground> ground;
  std::vector<Finish> finishes;
  std::optional<Finish> ground_finish;
  std::unique_ptr<RTCDeviceTy, Releaser> device;
  std::unique_ptr<RTCSceneTy, Releaser> rays;
};

RayScene::RayScene(Model model, const std::optional<Ground>& ground) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.model = std::move(model);
  s.ground = ground;
  for (const Material& material : s.model.materials) s.finishes.emplace_back(material);
  if (ground) s.ground_finish.emplace(ground_material(*ground));
  s.device.reset(rtcNewDevice("threads=1,set_affinity=0"));  // the same tree on every machine
  if (s.device == nullptr) throw Error(ExitCode::kUnexpected, "Embree, which traces the rays, did not start.");
  s.rays.reset(rtcNewScene(s.device.get()));
  rtcSetSceneFlags(s.rays.get(), RTC_SCENE_FLAG_ROBUST);
  for (const TriangleMesh& mesh : s.model.meshes) {
    RTCGeometry geometry = geometry_of(s.device.get(), mesh);
    rtcAttachGeometry(s.rays.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(s.rays.get());
  if (rtcGetDeviceError(s.device.get()) != RTC_ERROR_NONE)
    throw Error(ExitCode::kUnexpected, "Embree could not take the model; is there enough memory?");
}

RayScene::~RayScene() = default;

float RayScene::ground_distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  if (!state_->ground) return kFar;
  const Ground& ground = *state_->ground;
  const float fall = direction.dot(ground.up);
  if (fall == 0) return kFar;
  const float distance = (ground.point - origin).dot(ground.up) / fall;
  if (!(distance > 0)) return kFar;
  const Eigen::Vector3f from_centre = origin + distance * direction - ground.point;
  return from_centre.squaredNorm() <= ground.radius_m * ground.radius_m ? distance : kFar;
}

bool RayScene::hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, SurfaceHit& out) const {
  const State& s = *state_;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRayHit ray{};
  ray.ray = {origin.x(), origin.y(), origin.z(), 0, direction.x(), direction.y(), direction.z(), 0, kFar, ~0U, 0, 0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(s.rays.get(), &context, &ray);
  const float to_ground = ground_distance(origin, direction);
  if (to_ground < ray.ray.tfar) {
    const Eigen::Vector3f& up = s.ground->up;
    out.ground = true;
    out.distance = to_ground;
    out.position = origin + to_ground * direction;
    out.face = direction.dot(up) < 0 ? up : Eigen::Vector3f(-up);
    out.bsdf = {&*s.ground_finish, s.ground->albedo, out.face, -direction, false};
    return true;
  }
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const TriangleMesh& mesh = s.model.meshes[ray.hit.geomID];
  const Eigen::RowVector3i corner = mesh.triangles.row(static_cast<Eigen::Index>(ray.hit.primID));
  const Eigen::Vector3f weight(1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v);
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  out.position.setZero();
  for (int k = 0; k < 3; ++k) {
    normal += weight[k] * mesh.normals.row(corner[k]).transpose();
    out.position += weight[k] * mesh.vertices.row(corner[k]).transpose();
  }
  out.ground = false;
  out.distance = ray.ray.tfar;
  out.face = Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized();
  const Finish& finish = s.finishes[static_cast<std::size_t>(mesh.material)];
  const bool behind = out.face.dot(direction) > 0;
  if (behind) out.face = -out.face;
  if (normal.dot(out.face) < 0) normal = -normal;
  normal.normalize();
  // Of a surface that its smooth normals turn away from the viewer, the silhouette is seen.
  const float cosine = -normal.dot(direction);
  if (cosine < kLeastViewCosine) normal = (normal - (kLeastViewCosine - cosine) * direction).normalized();
  const MaterialKind kind = finish.material.kind;
  if (kind == MaterialKind::kMetal || kind == MaterialKind::kPlastic) normal = mirroring_outwards(normal, out.face, -direction);
  Eigen::Vector3f colour = finish.material.colour;
  if (!finish.material.texture.empty() && mesh.uv.rows() > 0) {
    Eigen::Vector2f uv = Eigen::Vector2f::Zero();
    for (int k = 0; k < 3; ++k) uv += weight[k] * mesh.uv.row(corner[k]).transpose();
    colour = colour.cwiseProduct(texel(finish.material.texture, uv)).cwiseMin(1.0F);
  }
  out.bsdf = {&finish, colour, normal, -direction, behind};
  return true;
}

bool RayScene::occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far,
                        bool by_ground) const {
  if (by_ground && ground_distance(origin, direction) < far) return true;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16)
      RTCRay ray{origin.x(), origin.y(), origin.z(), 0, direction.x(), direction.y(), direction.z(), 0, far, ~0U, 0, 0};
  rtcOccluded1(state_->rays.get(), &context, &ray);
  return ray.tfar < 0;  // Embree's sign for a hit
}

Eigen::Vector3f RayScene::start(const Eigen::Vector3f& position, const Eigen::Vector3f& face,
                                const Eigen::Vector3f& direction) {
  // Some units in the last place of the position's numbers.
  const float step = 2e-6F * (1e-3F + position.cwiseAbs().maxCoeff());
  return position + (direction.dot(face) >= 0 ? 4 * step : -4 * step) * face;
}

}  // namespace faceprobe::render
