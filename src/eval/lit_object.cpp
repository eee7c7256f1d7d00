#include "faceprobe/eval/lit_object.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr float kCoatIndex = 1.362F;
constexpr float kCoatF0 = ((kCoatIndex - 1) / (kCoatIndex + 1)) * ((kCoatIndex - 1) / (kCoatIndex + 1));
constexpr float kOffSurface = 1e-3F;  // of the object, which is two units long: where rays start above it

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct SurfacePoint {
  Eigen::Vector3f position, normal;
};

// The longer side of its box from -1 to 1, its middle at the origin.
synth::SurfaceMesh fitted(synth::SurfaceMesh mesh) {
  if (mesh.triangles.rows() == 0) throw std::invalid_argument("An object needs triangles.");
  const Eigen::RowVector3f low = mesh.vertices.colwise().minCoeff();
  const Eigen::RowVector3f high = mesh.vertices.colwise().maxCoeff();
  const float half = 0.5F * (high - low).head(2).maxCoeff();
  if (!(half > 0)) throw std::invalid_argument("An object needs an extent.");
  mesh.vertices = (mesh.vertices.rowwise() - 0.5F * (low + high)) / half;
  return mesh;
}

SurfacePoint point_of(const synth::Scene& scene, const synth::Hit& hit) {
  const synth::SurfaceMesh& mesh = scene.figures()[0].meshes[0];
  const Eigen::RowVector3i corner = mesh.triangles.row(hit.primitive);
  const Eigen::RowVector3f weight(1 - hit.u - hit.v, hit.u, hit.v);
  SurfacePoint point{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  for (int k = 0; k < 3; ++k) {
    point.position += weight[k] * mesh.vertices.row(corner[k]).transpose();
    point.normal += weight[k] * mesh.normals.row(corner[k]).transpose();
  }
  point.normal.normalize();
  return point;
}

}  // namespace

std::string LitObjectOptions::validate() const {
  if (size_px < 8 || size_px > 512) return "size_px must be from 8 to 512, found " + std::to_string(size_px) + ".";
  if (nside < 2 || nside > 32) return "nside must be from 2 to 32, found " + std::to_string(nside) + ".";
  return {};
}

struct LitObject::State {
  struct Pixel {
    int x = 0, y = 0;
    float fresnel = 0;
    Eigen::Vector3f mirrored;  // where the coat looks
    int other = -1;            // row of the object's own point that it sees there
  };

  explicit State(const LitObjectOptions& wanted)
      : options(wanted), grid(wanted.nside), mask(wanted.size_px, wanted.size_px, 1) {}

  LitObjectOptions options;
  SphereGrid grid;
  ByteImage mask;
  std::vector<Pixel> pixels;
  RowMatrix rows;  // pixels, then points that they mirror; x #cells: visible (N.L)+ dOmega / pi

  void trace(const synth::Scene& scene) {
    const int size = options.size_px;
    const Eigen::Vector3f view = Eigen::Vector3f::UnitZ();
    std::vector<SurfacePoint> points;
    std::vector<SurfacePoint> others;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float across = 2 * (static_cast<float>(x) + 0.5F) / static_cast<float>(size) - 1;
        const float up = 1 - 2 * (static_cast<float>(y) + 0.5F) / static_cast<float>(size);
        const synth::Hit hit = scene.first_hit({across, up, 100}, -view);
        if (hit.figure < 0) continue;
        SurfacePoint point = point_of(scene, hit);
        // Of a surface that smooth normals turn away from the viewer, the silhouette is seen.
        if (point.normal.z() < 0.01F) {
          point.normal.z() = 0.01F;
          point.normal.normalize();
        }
        Pixel pixel{x, y, schlick_fresnel(point.normal.z(), kCoatF0), 2 * point.normal.z() * point.normal - view, -1};
        const Eigen::Vector3f start = point.position + kOffSurface * point.normal;
        if (const synth::Hit seen = scene.first_hit(start, pixel.mirrored); seen.figure >= 0) {
          pixel.other = static_cast<int>(others.size());
          others.push_back(point_of(scene, seen));
        }
        mask(x, y) = 1;
        pixels.push_back(pixel);
        points.push_back(point);
      }
    }
    for (Pixel& pixel : pixels) pixel.other += pixel.other >= 0 ? static_cast<int>(points.size()) : 0;
    points.insert(points.end(), others.begin(), others.end());
    fill_rows(scene, points);
  }

  void fill_rows(const synth::Scene& scene, const std::vector<SurfacePoint>& points) {
    const Eigen::MatrixX3f& directions = grid.directions();
    const auto share = static_cast<float>(grid.cell_solid_angle() / kPi);
    rows.setZero(static_cast<Eigen::Index>(points.size()), grid.cell_count());
    parallel_for(static_cast<int>(points.size()), options.threads, [&](int first, int last) {
      std::vector<std::uint8_t> free(static_cast<std::size_t>(grid.cell_count()));
      for (int i = first; i < last; ++i) {
        const SurfacePoint& point = points[static_cast<std::size_t>(i)];
        scene.visible(point.position + kOffSurface * point.normal, directions, free.data());
        for (int j = 0; j < grid.cell_count(); ++j) {
          const float cosine = directions.row(j).dot(point.normal.transpose());
          if (cosine > 0 && free[static_cast<std::size_t>(j)] != 0) rows(i, j) = share * cosine;
        }
      }
    });
  }

  Eigen::RowVector3f radiance_at(const Eigen::MatrixX3f& radiance, const Eigen::Vector3f& direction) const {
    const SphereGrid::Interpolation at = grid.interpolate(direction);
    Eigen::RowVector3f value = Eigen::RowVector3f::Zero();
    for (std::size_t k = 0; k < 4; ++k) value += at.weight[k] * radiance.row(at.cell[k]);
    return value;
  }
};

LitObject::LitObject(const synth::SurfaceMesh& mesh, const LitObjectOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  synth::Figure figure;
  figure.meshes.push_back(fitted(mesh));
  const synth::Scene scene({std::move(figure)});
  state_ = std::make_unique<State>(options);
  state_->trace(scene);
}

LitObject::~LitObject() = default;
LitObject::LitObject(LitObject&&) noexcept = default;
LitObject& LitObject::operator=(LitObject&&) noexcept = default;

const ByteImage& LitObject::mask() const { return state_->mask; }

LitPictures LitObject::light(const Eigen::MatrixX3f& radiance) const {
  const State& s = *state_;
  if (radiance.rows() != s.grid.cell_count()) throw std::invalid_argument("An object needs one radiance per cell.");
  const Eigen::MatrixX3f shading = s.rows * radiance;
  const int size = s.options.size_px;
  LitPictures out{Image(size, size, 3), Image(size, size, 3)};
  for (std::size_t i = 0; i < s.pixels.size(); ++i) {
    const State::Pixel& pixel = s.pixels[i];
    const Eigen::RowVector3f diffuse = shading.row(static_cast<Eigen::Index>(i));
    const Eigen::RowVector3f mirrored =
        pixel.other < 0 ? s.radiance_at(radiance, pixel.mirrored) : Eigen::RowVector3f(shading.row(pixel.other));
    Eigen::Map<Eigen::RowVector3f>(out.diffuse.pixel(pixel.x, pixel.y)) = diffuse;
    Eigen::Map<Eigen::RowVector3f>(out.glossy.pixel(pixel.x, pixel.y)) =
        (1 - pixel.fresnel) * diffuse + pixel.fresnel * mirrored;
  }
  return out;
}

synth::SurfaceMesh sphere_mesh(int rings) {
  if (rings < 3) throw std::invalid_argument("A sphere needs three rings.");
  const int columns = 2 * rings;
  synth::SurfaceMesh mesh;
  mesh.material = synth::Material::kObject;
  mesh.vertices.resize((rings + 1) * columns, 3);
  mesh.triangles.resize(2 * rings * columns, 3);
  for (int r = 0; r <= rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double theta = kPi * r / rings;
      const double phi = 2 * kPi * c / columns;
      mesh.vertices.row(r * columns + c) =
          Eigen::RowVector3d(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi))
              .cast<float>();
    }
  }
  for (int r = 0; r < rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int right = (c + 1) % columns;
      const int a = r * columns + c;
      const int b = (r + 1) * columns + c;
      mesh.triangles.row(2 * a) = Eigen::RowVector3i(a, b, (r + 1) * columns + right);
      mesh.triangles.row(2 * a + 1) = Eigen::RowVector3i(a, (r + 1) * columns + right, r * columns + right);
    }
  }
  mesh.normals = mesh.vertices;
  return mesh;
}

}  // namespace faceprobe::eval
