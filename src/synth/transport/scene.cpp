#include "faceprobe/synth/scene.h"

#include "faceprobe/core/error.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr std::size_t kStream = 256;

struct Releaser {
  void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
  void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, Releaser>;
using Rays = std::unique_ptr<RTCSceneTy, Releaser>;

// What one of Embree's geometries is.
struct Part {
  int figure = 0;
  int part = 0;
  bool strand = false;
  std::vector<int> first_point;  // of each piece of strand
};

void check(const SurfaceMesh& mesh) {
  const bool fits = mesh.triangles.size() == 0 || (mesh.triangles.minCoeff() >= 0 &&
                                                   mesh.triangles.maxCoeff() < static_cast<int>(mesh.vertices.rows()));
  if (!fits) throw std::invalid_argument("A triangle names a vertex that is not there.");
  if (mesh.normals.rows() != mesh.vertices.rows()) throw std::invalid_argument("A mesh needs one normal per vertex.");
}

void check(const Strands& strands) {
  const std::vector<int>& first = strands.first_point;
  const bool fits = first.empty() || (first.front() >= 0 && first.back() <= static_cast<int>(strands.points.rows()) &&
                                      std::is_sorted(first.begin(), first.end()));
  if (!fits) throw std::invalid_argument("A strand names a point that is not there.");
}

RTCGeometry mesh_geometry(RTCDevice device, const SurfaceMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto vertex_count = static_cast<std::size_t>(mesh.vertices.rows());
  const auto triangle_count = static_cast<std::size_t>(mesh.triangles.rows());
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), triangle_count));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    for (int k = 0; k < 3; ++k) *vertices++ = mesh.vertices(v, k);
  }
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) *triangles++ = static_cast<unsigned>(mesh.triangles(t, k));
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

std::vector<int> pieces(const Strands& strands) {
  std::vector<int> out;
  for (std::size_t s = 0; s + 1 < strands.first_point.size(); ++s) {
    for (int p = strands.first_point[s]; p + 1 < strands.first_point[s + 1]; ++p) out.push_back(p);
  }
  return out;
}

// Ribbons that turn to every ray: they look like round hairs and cost half.
RTCGeometry strand_geometry(RTCDevice device, const Strands& strands, const std::vector<int>& first_point) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE);
  auto* points =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                  4 * sizeof(float), static_cast<std::size_t>(strands.points.rows())));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                                               sizeof(unsigned), first_point.size()));
  for (Eigen::Index p = 0; p < strands.points.rows(); ++p) {
    for (int k = 0; k < 4; ++k) *points++ = strands.points(p, k);
  }
  for (const int first : first_point) *index++ = static_cast<unsigned>(first);
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace

struct Scene::State {
  std::vector<Figure> figures;
  std::vector<std::vector<int>> offset;  // figure, mesh
  Eigen::MatrixX3f vertices;
  Eigen::MatrixX3f normals;
  Device device;
  // Lenses have a scene of their own: Embree as most systems ship it is built without ray masks.
  Rays solid, lenses;
  std::vector<Part> solid_parts, lens_parts;

  void add(RTCScene rays, RTCGeometry geometry, std::vector<Part>& parts, Part part) {
    rtcAttachGeometryByID(rays, geometry, static_cast<unsigned>(parts.size()));
    rtcReleaseGeometry(geometry);
    parts.push_back(std::move(part));
  }

  void add_figure(int f) {
    const Figure& figure = figures[static_cast<std::size_t>(f)];
    for (std::size_t m = 0; m < figure.meshes.size(); ++m) {
      const SurfaceMesh& mesh = figure.meshes[m];
      check(mesh);
      if (mesh.triangles.rows() == 0) continue;
      const bool lens = mesh.material == Material::kLens;
      add(lens ? lenses.get() : solid.get(), mesh_geometry(device.get(), mesh), lens ? lens_parts : solid_parts,
          {f, static_cast<int>(m), false, {}});
    }
    for (std::size_t s = 0; s < figure.strands.size(); ++s) {
      check(figure.strands[s]);
      std::vector<int> first_point = pieces(figure.strands[s]);
      if (first_point.empty()) continue;
      RTCGeometry geometry = strand_geometry(device.get(), figure.strands[s], first_point);
      add(solid.get(), geometry, solid_parts, {f, static_cast<int>(s), true, std::move(first_point)});
    }
  }

  void number_vertices() {
    int count = 0;
    for (const Figure& figure : figures) {
      offset.emplace_back();
      for (const SurfaceMesh& mesh : figure.meshes) {
        offset.back().push_back(count);
        count += static_cast<int>(mesh.vertices.rows());
      }
    }
    vertices.resize(count, 3);
    normals.resize(count, 3);
    for (std::size_t f = 0; f < figures.size(); ++f) {
      for (std::size_t m = 0; m < figures[f].meshes.size(); ++m) {
        const SurfaceMesh& mesh = figures[f].meshes[m];
        vertices.middleRows(offset[f][m], mesh.vertices.rows()) = mesh.vertices;
        normals.middleRows(offset[f][m], mesh.vertices.rows()) = mesh.normals;
      }
    }
  }

  void trace(RTCScene rays, const std::vector<Part>& parts, const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction, float near, float far, Hit& hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    alignas(16) RTCRayHit ray{};
    ray.ray = {origin.x(), origin.y(), origin.z(), near, direction.x(), direction.y(), direction.z(), 0,
               far,        ~0U,        0,          0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(rays, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    const Part& part = parts[ray.hit.geomID];
    hit = {part.figure, part.part,
           part.strand, part.strand ? part.first_point[ray.hit.primID] : static_cast<int>(ray.hit.primID),
           ray.hit.u,   part.strand ? 0.0F : ray.hit.v,
           ray.ray.tfar};
  }
};

Scene::Scene(std::vector<Figure> figures) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.figures = std::move(figures);
  // One thread builds the tree, so that it is the same whatever the machine; people are built side by side anyway.
  s.device.reset(rtcNewDevice("threads=1,set_affinity=0"));
  if (s.device == nullptr) throw Error(ExitCode::kUnexpected, "Embree, which traces the rays, did not start.");
  for (Rays* rays : {&s.solid, &s.lenses}) {
    rays->reset(rtcNewScene(s.device.get()));
    rtcSetSceneFlags(rays->get(), RTC_SCENE_FLAG_ROBUST);
  }
  for (std::size_t f = 0; f < s.figures.size(); ++f) s.add_figure(static_cast<int>(f));
  rtcCommitScene(s.solid.get());
  rtcCommitScene(s.lenses.get());
  if (rtcGetDeviceError(s.device.get()) != RTC_ERROR_NONE) {
    throw Error(ExitCode::kUnexpected, "Embree could not take the scene; is there enough memory?");
  }
  s.number_vertices();
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const std::vector<Figure>& Scene::figures() const { return state_->figures; }
int Scene::vertex_count() const { return static_cast<int>(state_->vertices.rows()); }
int Scene::vertex_offset(int figure, int mesh) const {
  return state_->offset[static_cast<std::size_t>(figure)][static_cast<std::size_t>(mesh)];
}
const Eigen::MatrixX3f& Scene::vertices() const { return state_->vertices; }
const Eigen::MatrixX3f& Scene::normals() const { return state_->normals; }

Hit Scene::first_hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near, float far,
                     bool lenses) const {
  Hit hit;
  state_->trace(state_->solid.get(), state_->solid_parts, origin, direction, near, far, hit);
  if (lenses && !state_->lens_parts.empty()) {
    state_->trace(state_->lenses.get(), state_->lens_parts, origin, direction, near, std::min(far, hit.distance), hit);
  }
  return hit;
}

bool Scene::occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near, float far) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  alignas(16) RTCRay ray{origin.x(), origin.y(), origin.z(), near, direction.x(), direction.y(), direction.z(), 0,
                         far,        ~0U,        0,          0};
  rtcOccluded1(state_->solid.get(), &context, &ray);
  return ray.tfar < 0;  // Embree's sign for a hit
}

void Scene::visible(std::span<const ShadowRay> rays, std::uint8_t* out) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  // Streams of single rays: measured on heads, they take two thirds of the time of packets of 8 or 16, coherent or not.
  alignas(16) std::array<RTCRay, kStream> stream;
  for (std::size_t first = 0; first < rays.size(); first += kStream) {
    const std::size_t count = std::min(kStream, rays.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const ShadowRay& ray = rays[first + i];
      stream[i] = {ray.origin.x(),
                   ray.origin.y(),
                   ray.origin.z(),
                   ray.near,
                   ray.direction.x(),
                   ray.direction.y(),
                   ray.direction.z(),
                   0,
                   ray.far,
                   ~0U,
                   0,
                   0};
    }
    rtcOccluded1M(state_->solid.get(), &context, stream.data(), static_cast<unsigned>(count), sizeof(RTCRay));
    for (std::size_t i = 0; i < count; ++i) out[first + i] = stream[i].tfar < 0 ? 0 : 1;
  }
}

void Scene::visible(const Eigen::Vector3f& origin, const Eigen::MatrixX3f& directions, std::uint8_t* out) const {
  std::vector<ShadowRay> rays(static_cast<std::size_t>(directions.rows()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i] = {origin, directions.row(static_cast<Eigen::Index>(i)).transpose()};
  }
  visible(rays, out);
}

}  // namespace faceprobe::synth
