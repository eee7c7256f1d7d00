#include "faceprobe/pipeline/found_meshes.h"

#include "faceprobe/core/color.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/synth/shard.h"

#include <algorithm>
#include <map>
#include <vector>

namespace faceprobe::pipeline {
namespace {

constexpr std::size_t kTries = 3;  // photos of a view, under other lights

// Of each shard, of each view in it, the samples that show it.
std::map<int, std::map<int, std::vector<int>>> samples_by_view(const synth::ShardReader& faces) {
  std::map<int, std::map<int, std::vector<int>>> shards;
  for (int number = 0; number < faces.sample_count(); ++number) {
    const auto [shard, view] = faces.view_place(number);
    shards[shard][view].push_back(number);
  }
  return shards;
}

synth::FoundMesh find_mesh(const synth::ShardReader& faces, const std::vector<int>& samples,
                           const face::FaceFinder& finder, const face::CanonicalMesh& mesh) {
  const synth::ViewLayers view = faces.copy_faces(samples[0]);
  const int width = view.region.width();
  const int height = view.region.height();
  const face::Camera camera{.focal_px = static_cast<double>(view.focal_px),
                            .centre_x_px = static_cast<double>(view.centre_px.x()),
                            .centre_y_px = static_cast<double>(view.centre_px.y())};
  const std::size_t tries = std::min(kTries, samples.size());
  for (std::size_t i = 0; i < tries; ++i) {
    const int number = samples[i * samples.size() / tries];
    const std::vector<face::Face> found = finder.find(decode_srgb(faces.copy_light(number).photo), camera);
    if (found.empty()) continue;
    face::FaceGeometry geometry = face::rasterize(face::largest_of(found), camera, mesh,
                                                  {.x_px = 0, .y_px = 0, .scale = 1, .width = width, .height = height});
    return {std::move(geometry.normal_cam), std::move(geometry.region)};
  }
  return {Image(width, height, 3), ByteImage(width, height, 1)};
}

}  // namespace

MeshCount find_meshes(const std::filesystem::path& folder, const face::FaceFinder& finder,
                      const std::function<void(int, int)>& progress) {
  const synth::ShardReader faces(folder);
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  auto shards = samples_by_view(faces);
  std::erase_if(shards,
                [&](const auto& shard) { return std::filesystem::exists(folder / synth::mesh_name(shard.first)); });
  MeshCount count;
  int done = 0;
  for (const auto& [shard, views] : shards) {
    std::vector<synth::FoundMesh> meshes;
    for (const auto& [view, samples] : views) meshes.push_back(find_mesh(faces, samples, finder, mesh));
    synth::write_meshes(folder, shard, meshes);
    count.views += static_cast<int>(meshes.size());
    count.found += static_cast<int>(std::ranges::count_if(meshes, [](const synth::FoundMesh& found) {
      return std::ranges::any_of(found.region.values(), [](std::uint8_t region) { return region != 0; });
    }));
    if (progress) progress(++done, static_cast<int>(shards.size()));
  }
  return count;
}

}  // namespace faceprobe::pipeline
