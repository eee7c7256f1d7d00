#include "render/ray_scene.h"

#include "faceprobe/core/error.h"
#include "render/numbers.h"
#include "render/texture.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr float kLeastViewCosine = 0.01F;

struct Releaser {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};

// What a hit needs of a corner, side by side: a hit in a large mesh is a few cache misses, not dozens.
struct Corner {
  Eigen::Vector3f position, normal;
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
};
struct PackedMesh {
  std::vector<Corner> corners;
  std::vector<Eigen::Vector3i> triangles;
  int material = 0;
  bool has_uv = false;
};

PackedMesh packed(const TriangleMesh& mesh) {
  PackedMesh out;
  out.material = mesh.material;
  out.has_uv = mesh.uv.rows() > 0;
  out.corners.resize(static_cast<std::size_t>(mesh.vertices.rows()));
  for (std::size_t i = 0; i < out.corners.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    out.corners[i] = {
        mesh.vertices.row(row).transpose(), mesh.normals.row(row).transpose(),
        out.has_uv ? Eigen::Vector2f(mesh.uv.row(row).transpose()) : Eigen::Vector2f(Eigen::Vector2f::Zero())};
  }
  out.triangles.resize(static_cast<std::size_t>(mesh.triangles.rows()));
  for (std::size_t i = 0; i < out.triangles.size(); ++i)
    out.triangles[i] = mesh.triangles.row(static_cast<Eigen::Index>(i)).transpose();
  return out;
}

[[noreturn]] void fail() {
  throw Error(ExitCode::kUnexpected, "Embree could not take the model; is there enough memory?");
}

void attach(RTCDevice device, RTCScene scene, const PackedMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.corners.size()));
  auto* corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                3 * sizeof(unsigned), mesh.triangles.size()));
  const bool empty = mesh.corners.empty() || mesh.triangles.empty();
  if (!empty && (position == nullptr || corner == nullptr)) {
    rtcReleaseGeometry(geometry);
    fail();
  }
  if (!empty) {
    for (const Corner& from : mesh.corners) position = std::copy_n(from.position.data(), 3, position);
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      for (int k = 0; k < 3; ++k) *corner++ = static_cast<unsigned>(triangle[k]);
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

// A smooth normal that mirrors the viewer into the surface, where only a black rim would be, is bent until it mirrors along it, as Cycles does.
Eigen::Vector3f mirroring_outwards(const Eigen::Vector3f& normal, const Eigen::Vector3f& face,
                                   const Eigen::Vector3f& view) {
  constexpr float kLeastHeight = 0.01F;
  const Eigen::Vector3f mirrored = 2 * normal.dot(view) * normal - view;
  const float least = std::min(0.9F * face.dot(view), kLeastHeight);
  const float height = mirrored.dot(face);
  if (height >= least) return normal;
  return ((mirrored + (least - height) * face).normalized() + view).normalized();
}

// Towards the viewer, as far as it has to be.
Eigen::Vector3f shading_normal(Eigen::Vector3f normal, const Eigen::Vector3f& face, const Eigen::Vector3f& view,
                               bool mirrors) {
  if (normal.dot(face) < 0) normal = -normal;
  normal.normalize();
  // Of a surface that its smooth normals turn away from the viewer, the silhouette is seen.
  const float cosine = normal.dot(view);
  if (cosine < kLeastViewCosine) normal = (normal + (kLeastViewCosine - cosine) * view).normalized();
  return mirrors ? mirroring_outwards(normal, face, view) : normal;
}

Material ground_material(const Ground& ground) {
  return {.name = "ground", .kind = MaterialKind::kDiffuse, .colour = ground.albedo};
}

}  // namespace

struct RayScene::State {
  std::vector<PackedMesh> meshes;
  std::optional<Ground> ground;
  std::vector<Finish> finishes;
  std::optional<Finish> ground_finish;
  std::unique_ptr<RTCDeviceTy, Releaser> device;
  std::unique_ptr<RTCSceneTy, Releaser> rays;
};

RayScene::RayScene(Model model, const std::optional<Ground>& ground) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.ground = ground;
  for (Material& material : model.materials) s.finishes.emplace_back(std::move(material));
  if (ground) s.ground_finish.emplace(ground_material(*ground));
  s.device.reset(rtcNewDevice("threads=1,set_affinity=0"));  // the same tree on every machine
  if (s.device == nullptr) throw Error(ExitCode::kUnexpected, "Embree, which traces the rays, did not start.");
  s.rays.reset(rtcNewScene(s.device.get()));
  rtcSetSceneFlags(s.rays.get(), RTC_SCENE_FLAG_ROBUST);
  for (TriangleMesh& mesh : model.meshes) {
    s.meshes.push_back(packed(mesh));
    mesh = {};
    attach(s.device.get(), s.rays.get(), s.meshes.back());
  }
  rtcCommitScene(s.rays.get());
  if (rtcGetDeviceError(s.device.get()) != RTC_ERROR_NONE) fail();
}

RayScene::~RayScene() = default;

float RayScene::ground_distance(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  if (!state_->ground) return kFar;
  const Ground& ground = *state_->ground;
  const float fall = direction.dot(ground.up);
  if (fall >= 0) return kFar;  // from below it is not there
  const float distance = (ground.point_m - origin).dot(ground.up) / fall;
  if (!(distance > 0)) return kFar;
  const Eigen::Vector3f from_centre = origin + distance * direction - ground.point_m;
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
    out.ground = true;
    out.distance = to_ground;
    out.position = origin + to_ground * direction;
    out.face = s.ground->up;
    out.bsdf = {&*s.ground_finish, s.ground->albedo, out.face, -direction, false};
    return true;
  }
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const PackedMesh& mesh = s.meshes[ray.hit.geomID];
  const Eigen::Vector3i& triangle = mesh.triangles[ray.hit.primID];
  const Eigen::Vector3f weight(1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v);
  Corner at{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  for (int k = 0; k < 3; ++k) {
    const Corner& corner = mesh.corners[static_cast<std::size_t>(triangle[k])];
    at.position += weight[k] * corner.position;
    at.normal += weight[k] * corner.normal;
    at.uv += weight[k] * corner.uv;
  }
  out.ground = false;
  out.distance = ray.ray.tfar;
  out.position = at.position;
  out.face = Eigen::Vector3f(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z).normalized();
  const bool behind = out.face.dot(direction) > 0;
  if (behind) out.face = -out.face;
  const Finish& finish = s.finishes[static_cast<std::size_t>(mesh.material)];
  const MaterialKind kind = finish.material.kind;
  const bool mirrors = kind == MaterialKind::kMetal || kind == MaterialKind::kPlastic;
  const Eigen::Vector3f normal = shading_normal(at.normal, out.face, -direction, mirrors);
  Eigen::Vector3f colour = finish.material.colour;
  if (!finish.material.texture.empty() && mesh.has_uv)
    colour = colour.cwiseProduct(texel(finish.material.texture, at.uv)).cwiseMin(1.0F);
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
