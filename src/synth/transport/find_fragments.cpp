#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/fragments.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace faceprobe::synth {
namespace {

constexpr std::size_t kMostPerPixel = 4;
constexpr float kLeastNormalView = 0.02F;  // cosine: smooth normals on the rim may look away from the camera a little
constexpr float kWidestUv = 0.1F;          // corners farther apart than this lie across a seam

struct Sample {
  Hit hit;
  Eigen::Vector3f direction{0, 0, 0};  // of the primary ray
  Eigen::Vector3f position{0, 0, 0};
  Eigen::Vector3f normal{0, 0, 0};
  Eigen::Vector3f tangent{0, 0, 0};
  Eigen::Vector2f uv{0, 0};
  float tone = 1;
  float depth_m = 0;
  float slope_variance = 0;
};

// One surface in one pixel.
struct Group {
  std::vector<Sample> samples;
  bool lens = false;
};

// Everything about a fragment, before it goes to its columns.
struct Found {
  int pixel = 0;
  float coverage = 0;
  Material material = Material::kSkin;
  Region region = Region::kNone;
  Sample mean;
  Eigen::RowVector3i vertex{-1, -1, -1};
  Eigen::RowVector3f weights{0, 0, 0};
  std::vector<std::pair<int, float>> mix;
};

class PixelWorker {
 public:
  PixelWorker(const Scene& scene, const PinholeCamera& camera, int side)
      : scene_(scene), camera_(camera), side_(side), scene_from_camera_(camera.camera_from_scene.inverse()) {
    for (const Figure& figure : scene.figures()) {
      for (const SurfaceMesh& mesh : figure.meshes) lenses_ = lenses_ || mesh.material == Material::kLens;
    }
  }

  void work(int x, int y, std::vector<Found>& out) {
    groups_.clear();
    const Eigen::Vector3f origin = scene_from_camera_.translation();
    const auto n = static_cast<float>(side_);
    for (int j = 0; j < side_; ++j) {
      for (int i = 0; i < side_; ++i) {
        // A sheared grid: as many different columns and rows as samples, so that upright edges are smooth too.
        const float fx = (static_cast<float>(i) + (static_cast<float>(j) + 0.5F) / n) / n;
        const float fy = (static_cast<float>(j) + (static_cast<float>(side_ - 1 - i) + 0.5F) / n) / n;
        const Eigen::Vector2f point(static_cast<float>(x) + fx, static_cast<float>(y) + fy);
        const Eigen::Vector3f direction = scene_from_camera_.linear() * camera_.ray_cam(point);
        const Hit hit = scene_.first_hit(origin, direction);
        if (hit.figure >= 0) add(hit, origin, direction, false);
        if (!lenses_) continue;
        const Hit first = scene_.first_hit(origin, direction, 0, hit.distance, true);
        if (first.figure >= 0 && first.distance < hit.distance) add(first, origin, direction, true);
      }
    }
    split_at_steps();
    keep_largest();
    for (const Group& group : groups_) out.push_back(finish(group, y * camera_.width_px + x));
  }

 private:
  void add(const Hit& hit, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, bool lens) {
    Sample sample;
    sample.hit = hit;
    sample.direction = direction;
    sample.position = origin + hit.distance * direction;
    sample.depth_m = -(camera_.camera_from_scene * sample.position).z();
    if (hit.strand) {
      describe_strand(sample);
    } else {
      describe_surface(sample);
    }
    const auto same = std::ranges::find_if(groups_, [&](const Group& group) {
      const Hit& other = group.samples.front().hit;
      return other.figure == hit.figure && other.part == hit.part && other.strand == hit.strand && group.lens == lens;
    });
    if (same == groups_.end()) {
      groups_.push_back({{sample}, lens});
    } else {
      same->samples.push_back(sample);
    }
  }

  void describe_strand(Sample& sample) const {
    const Hit& hit = sample.hit;
    const Strands& strands =
        scene_.figures()[static_cast<std::size_t>(hit.figure)].strands[static_cast<std::size_t>(hit.part)];
    const Eigen::Vector3f a = strands.points.row(hit.primitive).head<3>().transpose();
    const Eigen::Vector3f b = strands.points.row(hit.primitive + 1).head<3>().transpose();
    sample.tangent = (b - a).normalized();
    const Eigen::Vector3f across = -sample.direction + sample.direction.dot(sample.tangent) * sample.tangent;
    sample.normal = across.squaredNorm() > 0 ? Eigen::Vector3f(across.normalized()) : Eigen::Vector3f(-sample.direction);
    const auto after = std::upper_bound(strands.first_point.begin(), strands.first_point.end(), hit.primitive);
    const auto strand = static_cast<std::size_t>(after - strands.first_point.begin() - 1);
    if (strand < strands.tone.size()) sample.tone = strands.tone[strand];
  }

  void describe_surface(Sample& sample) const {
    const Hit& hit = sample.hit;
    const SurfaceMesh& mesh =
        scene_.figures()[static_cast<std::size_t>(hit.figure)].meshes[static_cast<std::size_t>(hit.part)];
    const Eigen::RowVector3f weights(1 - hit.u - hit.v, hit.u, hit.v);
    const Eigen::RowVector3i corners = mesh.triangles.row(hit.primitive);
    Eigen::RowVector3f normal = Eigen::RowVector3f::Zero();
    for (int k = 0; k < 3; ++k) normal += weights(k) * mesh.normals.row(corners(k));
    const Eigen::RowVector3f a = mesh.vertices.row(corners(0));
    const Eigen::RowVector3f face = (mesh.vertices.row(corners(1)) - a).cross(mesh.vertices.row(corners(2)) - a);
    // An open sheet, or a lens, seen from behind.
    if (face.dot(sample.direction.transpose()) > 0) normal = -normal;
    sample.normal = normal.normalized().transpose();
    if (mesh.uv.rows() == 0) return;
    for (int k = 0; k < 3; ++k) sample.uv += weights(k) * mesh.uv.row(mesh.triangle_uv(hit.primitive, k)).transpose();
  }

  // One mesh may lie before itself, as a nose before its cheek: apart where the depth jumps by more than a slope would.
  void split_at_steps() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (groups_[g].samples.front().hit.strand) continue;
      std::vector<Sample>& samples = groups_[g].samples;
      std::stable_sort(samples.begin(), samples.end(),
                       [](const Sample& a, const Sample& b) { return a.depth_m < b.depth_m; });
      const float step = std::max(0.006F, 6.0F * samples.front().depth_m / camera_.focal_px);
      for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].depth_m - samples[i - 1].depth_m <= step) continue;
        Group behind{{samples.begin() + static_cast<std::ptrdiff_t>(i), samples.end()}, groups_[g].lens};
        samples.resize(i);
        groups_.push_back(std::move(behind));
        break;
      }
    }
  }

  // What is dropped gives its share to the largest: at that size nobody sees which it was.
  void keep_largest() {
    std::stable_sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
      return a.lens != b.lens ? !a.lens : a.samples.size() > b.samples.size();
    });
    extra_.assign(groups_.size(), 0);
    std::size_t kept = 0;
    std::size_t solid = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (!groups_[g].lens && solid == kMostPerPixel) {
        extra_[0] += groups_[g].samples.size();
        continue;
      }
      solid += groups_[g].lens ? 0 : 1;
      if (kept != g) groups_[kept] = std::move(groups_[g]);
      ++kept;
    }
    groups_.resize(kept);
  }

  Found finish(const Group& group, int pixel) const {
    const std::vector<Sample>& samples = group.samples;
    const Hit& hit = samples.front().hit;
    const auto n = static_cast<float>(samples.size());
    Found found;
    found.pixel = pixel;
    const std::size_t extra = &group == groups_.data() && !group.lens ? extra_[0] : 0;
    found.coverage = (n + static_cast<float>(extra)) / static_cast<float>(side_ * side_);
    Sample& mean = found.mean;
    mean.hit = hit;
    mean.tone = 0;
    for (const Sample& s : samples) {
      mean.direction += s.direction / n;
      mean.position += s.position / n;
      mean.normal += s.normal / n;
      mean.tangent += (s.tangent.dot(samples.front().tangent) < 0 ? -1.0F : 1.0F) / n * s.tangent;
      mean.tone += s.tone / n;
      mean.depth_m += s.depth_m / n;
    }
    const Sample& nearest = *std::ranges::min_element(
        samples, {}, [&](const Sample& s) { return (s.position - mean.position).squaredNorm(); });
    mean.hit = nearest.hit;
    for (const Sample& s : samples) {
      const bool across_seam = (s.uv - nearest.uv).cwiseAbs().maxCoeff() > kWidestUv;
      mean.uv += (across_seam ? nearest.uv : s.uv) / n;
    }
    if (hit.strand) {
      finish_strand(found, nearest);
    } else {
      finish_surface(found, nearest);
      found.mix = mix(samples);
    }
    return found;
  }

  // Vertices of all samples, each once.
  std::vector<std::pair<int, float>> mix(const std::vector<Sample>& samples) const {
    const Hit& first = samples.front().hit;
    const SurfaceMesh& mesh =
        scene_.figures()[static_cast<std::size_t>(first.figure)].meshes[static_cast<std::size_t>(first.part)];
    const int offset = scene_.vertex_offset(first.figure, first.part);
    std::vector<std::pair<int, float>> out;
    for (const Sample& s : samples) {
      const float weights[3] = {1 - s.hit.u - s.hit.v, s.hit.u, s.hit.v};
      for (int k = 0; k < 3; ++k) {
        const int vertex = offset + mesh.triangles(s.hit.primitive, k);
        const float weight = weights[k] / static_cast<float>(samples.size());
        const auto same = std::ranges::find(out, vertex, &std::pair<int, float>::first);
        if (same == out.end()) {
          out.emplace_back(vertex, weight);
        } else {
          same->second += weight;
        }
      }
    }
    return out;
  }

  void finish_strand(Found& found, const Sample& nearest) const {
    Sample& mean = found.mean;
    const Hit& hit = mean.hit;
    found.material = Material::kHair;
    found.region =
        scene_.figures()[static_cast<std::size_t>(hit.figure)].strands[static_cast<std::size_t>(hit.part)].region;
    mean.position = nearest.position;  // on a hair, not between hairs
    mean.tangent = mean.tangent.squaredNorm() > 1e-6F ? Eigen::Vector3f(mean.tangent.normalized()) : nearest.tangent;
    const Eigen::Vector3f across = -mean.direction + mean.direction.dot(mean.tangent) * mean.tangent;
    mean.normal = across.squaredNorm() > 1e-6F ? Eigen::Vector3f(across.normalized()) : nearest.normal;
  }

  void finish_surface(Found& found, const Sample& nearest) const {
    Sample& mean = found.mean;
    const Hit& hit = mean.hit;
    const SurfaceMesh& mesh =
        scene_.figures()[static_cast<std::size_t>(hit.figure)].meshes[static_cast<std::size_t>(hit.part)];
    found.material = mesh.material;
    found.weights = {1 - hit.u - hit.v, hit.u, hit.v};
    Eigen::Index strongest = 0;
    found.weights.maxCoeff(&strongest);
    const int vertex = mesh.triangles(hit.primitive, strongest);
    if (static_cast<std::size_t>(vertex) < mesh.vertex_region.size()) {
      found.region = mesh.vertex_region[static_cast<std::size_t>(vertex)];
    }
    found.vertex = mesh.triangles.row(hit.primitive).array() + scene_.vertex_offset(hit.figure, hit.part);
    Eigen::Vector3f normal =
        mean.normal.squaredNorm() > 1e-6F ? Eigen::Vector3f(mean.normal.normalized()) : nearest.normal;
    mean.slope_variance = 0.5F * std::max(0.0F, 1.0F - mean.normal.squaredNorm());
    const Eigen::Vector3f view = -mean.direction.normalized();
    const float cosine = normal.dot(view);
    if (cosine < kLeastNormalView) normal = (normal + (kLeastNormalView - cosine) * view).normalized();
    mean.normal = normal;
  }

  const Scene& scene_;
  const PinholeCamera& camera_;
  int side_;
  Eigen::Isometry3f scene_from_camera_;
  bool lenses_ = false;
  std::vector<Group> groups_;
  std::vector<std::size_t> extra_;
};

Fragments to_columns(const std::vector<std::vector<Found>>& rows, const PinholeCamera& camera) {
  Fragments out;
  out.width_px = camera.width_px;
  out.height_px = camera.height_px;
  out.pixel_rad = 1.0F / camera.focal_px;
  Eigen::Index count = 0;
  for (const auto& row : rows) count += static_cast<Eigen::Index>(row.size());
  for (Eigen::MatrixX3f* matrix : {&out.position, &out.normal, &out.tangent, &out.weights}) matrix->resize(count, 3);
  out.uv.resize(count, 2);
  out.vertex.resize(count, 3);
  out.depth_m.resize(count);
  out.slope_variance.resize(count);
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    for (const Found& found : row) {
      out.pixel.push_back(found.pixel);
      out.coverage.push_back(found.coverage);
      out.material.push_back(found.material);
      out.region.push_back(found.region);
      out.figure.push_back(static_cast<std::uint16_t>(found.mean.hit.figure));
      out.part.push_back(static_cast<std::uint16_t>(found.mean.hit.part));
      out.tone.push_back(found.mean.tone);
      out.position.row(i) = found.mean.position.transpose();
      out.normal.row(i) = found.mean.normal.transpose();
      out.tangent.row(i) = found.mean.tangent.transpose();
      out.uv.row(i) = found.mean.uv.transpose();
      out.vertex.row(i) = found.vertex;
      out.weights.row(i) = found.weights;
      out.depth_m(i) = found.mean.depth_m;
      out.slope_variance(i) = found.mean.slope_variance;
      for (const auto& [vertex, weight] : found.mix) {
        out.mix_vertex.push_back(vertex);
        out.mix_weight.push_back(weight);
      }
      out.mix_first.push_back(static_cast<int>(out.mix_vertex.size()));
      ++i;
    }
  }
  return out;
}

}  // namespace

Fragments find_fragments(const Scene& scene, const PinholeCamera& camera, const FragmentOptions& options) {
  std::vector<std::vector<Found>> rows(static_cast<std::size_t>(std::max(0, camera.height_px)));
  parallel_for(camera.height_px, options.threads, [&](int first, int last) {
    PixelWorker worker(scene, camera, std::max(1, options.samples_per_side));
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < camera.width_px; ++x) worker.work(x, y, rows[static_cast<std::size_t>(y)]);
    }
  });
  return to_columns(rows, camera);
}

}  // namespace faceprobe::synth
