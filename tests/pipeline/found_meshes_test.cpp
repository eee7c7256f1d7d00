#include "faceprobe/pipeline/found_meshes.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/synth/shard.h"
#include "pipeline/portrait.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::pipeline {
namespace {

// A view that shows the portrait in its second light only, and one that shows nobody.
TEST(FoundMeshes, AreWhatTheFinderSeesInSomePhotoOfAView) {
  const faceprobe::testing::TempFolder folder;
  const std::filesystem::path data = folder / "faces";
  const ByteImage portrait = encode_srgb(testing::portrait().linear);
  const int size = std::max(portrait.width(), portrait.height());
  ByteImage photo(size, size, 3);
  for (int y = 0; y < portrait.height(); ++y)
    std::copy_n(portrait.pixel(0, y), portrait.row(y).size(), photo.pixel(0, y));
  const ByteImage black(size, size, 3);
  std::vector<synth::ViewSamples> views(2);
  for (std::size_t v = 0; v < 2; ++v) {
    views[v].view.normal = Image(size, size, 3);
    views[v].view.depth_m = Image(size, size, 1);
    views[v].view.region = views[v].view.owner = ByteImage(size, size, 1);
    views[v].view.focal_px = 1.5F * static_cast<float>(size);
    views[v].view.centre_px = {0.5F * static_cast<float>(size), 0.5F * static_cast<float>(size)};
    views[v].view.faces.resize(1);
    for (int light = 0; light < 2; ++light) {
      synth::Sample sample;
      sample.photo = v == 0 && light == 1 ? photo : black;
      sample.clip = ByteImage(size, size, 1);
      sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(size, size, 3);
      sample.environment = EnvMap(4, 2);
      sample.settings_json = "{}";
      views[v].samples.push_back(std::move(sample));
    }
  }
  const synth::ShardWriter writer(data, {.size_px = size, .environment_height = 2, .recipe = "{}"});
  writer.write(0, views);
  writer.finish(1, "");

  const face::FaceFinder finder;
  const MeshCount count = find_meshes(data, finder);
  EXPECT_EQ(count.views, 2);
  EXPECT_EQ(count.found, 1);
  const synth::ShardReader reader(data);
  const synth::FoundMesh found = reader.copy_mesh(0);
  const auto on_mesh = [](const synth::FoundMesh& mesh) {
    return std::ranges::count_if(mesh.region.values(), [](std::uint8_t region) { return region != 0; });
  };
  EXPECT_GT(on_mesh(found), 5000);
  EXPECT_EQ(on_mesh(reader.copy_mesh(2)), 0);
  // The face looks at the camera.
  double forward = 0;
  for (std::size_t i = 0; i < found.region.pixel_count(); ++i)
    forward += static_cast<double>(found.normal_cam.data()[3 * i + 2]);
  EXPECT_GT(forward / static_cast<double>(on_mesh(found)), 0.7);
  // What is there is left as it is.
  EXPECT_EQ(find_meshes(data, finder).views, 0);
}

TEST(FoundMeshes, AFolderThatIsNoDataSetIsRefused) {
  const faceprobe::testing::TempFolder folder;
  EXPECT_THROW(find_meshes(folder / "absent", face::FaceFinder()), Error);
}

}  // namespace
}  // namespace faceprobe::pipeline
