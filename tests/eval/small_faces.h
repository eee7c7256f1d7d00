#pragma once
// A data set of a few "faces" for the benchmarks: a ball of cheek under a light from the front, matt; their map has a lamp there.

#include "faceprobe/core/color.h"
#include "faceprobe/core/region.h"
#include "faceprobe/synth/shard.h"
#include "support/temp_folder.h"

#include <cmath>

namespace faceprobe::eval {

struct SmallFaces {
  static constexpr int kSize = 32;

  SmallFaces() {
    synth::ViewSamples out;
    out.view.normal = Image(kSize, kSize, 3);
    out.view.depth_m = Image(kSize, kSize, 1, 1.0F);
    out.view.region = ByteImage(kSize, kSize, 1);
    out.view.owner = ByteImage(kSize, kSize, 1);
    out.view.focal_px = 60;
    out.view.centre_px = {kSize / 2.0F, kSize / 2.0F};
    out.view.faces.resize(1);
    synth::Sample sample;
    sample.photo = ByteImage(kSize, kSize, 3);
    sample.clip = ByteImage(kSize, kSize, 1);
    sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(kSize, kSize, 3);
    sample.environment = EnvMap(32, 16);
    for (float& value : sample.environment.radiance().values()) value = 0.1F;
    for (int c = 0; c < 3; ++c) sample.environment.radiance()(16, 8, c) = 20;
    sample.settings_json = "{}";
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const float u = (static_cast<float>(x) + 0.5F) / 14 - kSize / 28.0F;
        const float v = kSize / 28.0F - (static_cast<float>(y) + 0.5F) / 14;
        if (u * u + v * v > 0.9F) continue;
        const float w = std::sqrt(1 - u * u - v * v);
        out.view.normal(x, y, 0) = u;
        out.view.normal(x, y, 1) = v;
        out.view.normal(x, y, 2) = w;
        out.view.region(x, y) = static_cast<std::uint8_t>(v > 0 ? Region::kForehead : Region::kCheeks);
        out.view.owner(x, y) = 1;
        const float albedo[3] = {0.6F, 0.4F, 0.3F};
        for (int c = 0; c < 3; ++c) {
          sample.albedo(x, y, c) = albedo[c];
          sample.shading(x, y, c) = w * (1 + 0.1F * static_cast<float>(c));
          sample.diffuse(x, y, c) = sample.albedo(x, y, c) * sample.shading(x, y, c);
          sample.photo(x, y, c) =
              static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(sample.diffuse(x, y, c))));
        }
      }
    }
    view = out.view;
    truth = sample;
    for (int i = 0; i < 3; ++i) out.samples.push_back(sample);
    const synth::ShardWriter writer(path(), {.size_px = kSize, .environment_height = 16, .recipe = R"({"seed":1})"});
    writer.write(0, std::vector<synth::ViewSamples>{out});
    writer.finish(1, "");
  }
  std::filesystem::path path() const { return folder / "data"; }

  testing::TempFolder folder;
  synth::ViewLayers view;
  synth::Sample truth;
};

}  // namespace faceprobe::eval
