#include "faceprobe/pipeline/traced_photos.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/pixel_box.h"
#include "faceprobe/core/region.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/lighting/face_features.h"
#include "faceprobe/synth/photo_layers.h"
#include "faceprobe/synth/shard.h"
#include "faceprobe/synth/traced.h"
#include "pipeline/read_layers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace faceprobe::pipeline {
namespace {

constexpr Eigen::Index kLeastPatches = 30;  // as an estimate wants

// The crop that face::face_crop makes of the mesh's box.
std::optional<Window> crop_of(const ByteImage& region) {
  const std::optional<PixelBox> box = box_of(region);
  if (!box) return std::nullopt;
  const double margin = face::GeometryOptions{}.margin;
  const double across = margin * box->width();
  const double down = margin * box->height();
  const double x0 = std::floor(box->left - across);
  const double y0 = std::floor(box->top - down);
  return Window{x0, y0, 1, static_cast<int>(std::ceil(box->right + across) - x0),
                static_cast<int>(std::ceil(box->bottom + down) - y0)};
}

face::Camera camera_of(const synth::ViewLayers& view) {
  return {.focal_px = static_cast<double>(view.focal_px),
          .centre_x_px = static_cast<double>(view.centre_px.x()),
          .centre_y_px = static_cast<double>(view.centre_px.y())};
}

// The photo in its crop, as Estimator has it; the surface's place in space, which only shadows need, is left out.
FaceEstimate face_of(const synth::Sample& sample, const face::Camera& camera, const synth::FoundMesh& mesh,
                     const Window& window) {
  FaceEstimate face;
  face.picture = resampled(synth::photo_layers(sample).linear, window);
  face.clipped = resampled(sample.clip, window, 0xFF);
  face::FaceGeometry& geometry = face.geometry;
  geometry.crop = {window.left_px, window.top_px, 1, window.width, window.height};
  geometry.normal_cam = resampled(mesh.normal_cam, window);
  geometry.region = resampled(mesh.region, window, 0);
  geometry.position_cam_m = geometry.view_cam = Image(window.width, window.height, 3);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      Eigen::Map<Eigen::Vector3f>(geometry.view_cam.pixel(x, y)) =
          camera.view_direction(x + 0.5 + window.left_px, y + 0.5 + window.top_px).cast<float>();
    }
  }
  return face;
}

std::optional<synth::TracedPhoto> trace_photo(const synth::ShardReader& faces, int number, const FaceReader& reader,
                                              const EstimateOptions& options) {
  const synth::FoundMesh mesh = faces.copy_mesh(number);
  const std::optional<Window> window = crop_of(mesh.region);
  if (!window) return std::nullopt;
  const synth::Sample sample = faces.copy_sample(number);
  if (!sample.lamps.empty()) return std::nullopt;  // a group's room: no one map lights it
  const face::Camera camera = camera_of(faces.copy_view(number));
  FaceEstimate face = face_of(sample, camera, mesh, *window);
  read_layers(reader, options, camera, false, true, face);
  const float level = lighting::shading_level(face.observations);
  if (face.observations.count() < kLeastPatches || !(level > 0)) return std::nullopt;
  const SphereGrid grid(lighting::kFeatureNside);
  return synth::TracedPhoto{lighting::face_features(face.observations),
                            grid_from_env_map(sample.environment, grid) / level};
}

// Of each shard the photos to read.
std::map<int, std::vector<int>> photos_by_shard(const synth::ShardReader& faces, int most) {
  std::map<int, std::vector<int>> shards;
  const int taken = std::min(most, faces.sample_count());
  for (int i = 0; i < taken; ++i) {
    const auto number = static_cast<int>(static_cast<long long>(i) * faces.sample_count() / taken);
    shards[faces.view_place(number).first].push_back(number);
  }
  return shards;
}

}  // namespace

TraceCount trace_photos(const std::filesystem::path& folder, const TraceRun& run,
                        const std::function<void(int, int)>& progress) {
  const synth::ShardReader faces(folder);
  if (!faces.has_meshes()) {
    throw Error(ExitCode::kInput, "The data in " + folder.string() +
                                      " do not have the meshes that are found in them. Run `faceprobe mesh " +
                                      folder.string() + "` first.");
  }
  // Photos beside one another, each on one thread: small networks share their work badly.
  EstimateOptions options = run.options;
  options.threads = 1;
  const FaceReader reader(options);
  auto shards = photos_by_shard(faces, run.most);
  std::erase_if(shards,
                [&](const auto& shard) { return std::filesystem::exists(folder / synth::traced_name(shard.first)); });
  TraceCount count;
  int done = 0;
  for (const auto& [shard, numbers] : shards) {
    std::vector<std::optional<synth::TracedPhoto>> found(numbers.size());
    parallel_for(static_cast<int>(numbers.size()), run.options.threads, [&](int first, int last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        found[i] = trace_photo(faces, numbers[i], reader, options);
    });
    std::vector<synth::TracedPhoto> photos;
    for (std::optional<synth::TracedPhoto>& photo : found) {
      if (photo) photos.push_back(std::move(*photo));
    }
    count.photos += static_cast<int>(numbers.size());
    count.traced += static_cast<int>(photos.size());
    if (!photos.empty()) synth::write_traced(folder, shard, photos);
    if (progress) progress(++done, static_cast<int>(shards.size()));
  }
  return count;
}

}  // namespace faceprobe::pipeline
