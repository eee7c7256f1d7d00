#pragma once
// A folder of synthetic "faces" small enough to train on in a test: discs of one colour with a bright spot of known light.

#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/region.h"
#include "faceprobe/synth/shard.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace faceprobe::train {

inline synth::ViewSamples spotted_discs(int size, int samples, std::uint64_t seed) {
  Random random({seed});
  synth::ViewSamples out;
  out.view.normal = Image(size, size, 3);
  out.view.depth_m = Image(size, size, 1, 1.0F);
  out.view.region = ByteImage(size, size, 1, static_cast<std::uint8_t>(Region::kCheeks));
  out.view.owner = ByteImage(size, size, 1, 1);
  out.view.faces.resize(1);
  // The disc bulges towards the camera.
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = (2.0 * x + 1) / size - 1;
      const double v = 1 - (2.0 * y + 1) / size;
      const double w = std::sqrt(std::max(0.05, 1 - 0.45 * (u * u + v * v)));
      const double length = std::sqrt(0.45 * (u * u + v * v) + w * w);
      out.view.normal(x, y, 0) = static_cast<float>(std::sqrt(0.45) * u / length);
      out.view.normal(x, y, 1) = static_cast<float>(std::sqrt(0.45) * v / length);
      out.view.normal(x, y, 2) = static_cast<float>(w / length);
    }
  }
  for (int s = 0; s < samples; ++s) {
    synth::Sample sample;
    sample.photo = ByteImage(size, size, 3);
    sample.clip = ByteImage(size, size, 1);
    sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(size, size, 3);
    sample.environment = EnvMap(4, 2);
    const double x0 = random.between(0.3, 0.7) * size;
    const double y0 = random.between(0.3, 0.7) * size;
    const float skin = static_cast<float>(random.between(0.1, 0.4));
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const double r2 = (x - x0) * (x - x0) + (y - y0) * (y - y0);
        const auto spot = static_cast<float>(0.4 * std::exp(-r2 / (0.02 * size * size)));
        for (int c = 0; c < 3; ++c) {
          sample.highlight(x, y, c) = spot;
          sample.albedo(x, y, c) = skin * (c == 0 ? 1.0F : 0.6F);
          sample.shading(x, y, c) = 1;
          sample.diffuse(x, y, c) = sample.albedo(x, y, c) * sample.shading(x, y, c);
          const float whole = spot + sample.diffuse(x, y, c);
          sample.photo(x, y, c) =
              static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(std::min(1.0F, whole))));
          if (whole >= 1.0F) sample.clip(x, y) = static_cast<std::uint8_t>(sample.clip(x, y) | 1 << c);
        }
      }
    }
    sample.settings_json = "{}";
    out.samples.push_back(std::move(sample));
  }
  return out;
}

class DataFolder {
 public:
  DataFolder(const std::string& name, int size, int samples)
      : path_(std::filesystem::temp_directory_path() / ("faceprobe_train_" + std::to_string(::getpid()) + "_" + name)) {
    std::filesystem::remove_all(path_);
    const synth::ShardWriter writer(path_ / "data",
                                    {.size_px = size, .environment_height = 2, .recipe = R"({"seed":1})"});
    const std::vector<synth::ViewSamples> views = {spotted_discs(size, samples, 7)};
    writer.write(0, views);
    writer.finish(1, "");
    // A mesh that knows the face's place and that it looks at the camera.
    synth::FoundMesh mesh{Image(size, size, 3), views[0].view.region};
    for (std::size_t i = 0; i < mesh.normal_cam.values().size(); i += 3) mesh.normal_cam.data()[i + 2] = 1;
    synth::write_meshes(path_ / "data", 0, std::vector<synth::FoundMesh>{mesh});
  }
  ~DataFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  std::filesystem::path data() const { return path_ / "data"; }
  std::filesystem::path run(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace faceprobe::train
