#include "faceprobe/synth/traced.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/tensor_file.h"
#include "faceprobe/synth/shard.h"

#include <algorithm>
#include <string>

namespace faceprobe::synth {

std::string traced_name(int shard) { return "traced" + shard_name(shard).substr(std::string("shard").size()); }

void write_traced(const std::filesystem::path& folder, int shard, std::span<const TracedPhoto> photos) {
  const std::int64_t inputs = photos.empty() ? 0 : photos[0].features.size();
  const std::int64_t cells = photos.empty() ? 0 : photos[0].light.rows();
  const auto count = static_cast<std::int64_t>(photos.size());
  io::TensorFileBuilder file;
  const std::span<float> features = file.add<float>("photo.features", {count, inputs});
  const std::span<float> light = file.add<float>("photo.light", {count, cells, 3});
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    std::copy_n(photos[i].features.data(), inputs, features.data() + static_cast<std::int64_t>(i) * inputs);
    Eigen::Map<Rows>(light.data() + static_cast<std::int64_t>(i) * cells * 3, cells, 3) = photos[i].light;
  }
  file.write(folder / traced_name(shard));
}

std::vector<TracedPhoto> read_traced(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code problem;
  const std::filesystem::directory_iterator entries(folder, problem);
  if (problem) throw Error(ExitCode::kInput, folder.string() + " cannot be read: " + problem.message() + ".");
  for (const auto& entry : entries) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("traced-") && name.ends_with(".safetensors")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<TracedPhoto> photos;
  for (const std::filesystem::path& path : files) {
    const io::MappedTensors file(path);
    const std::span<const float> features = file.values<float>("photo.features", {-1, -1});
    const std::int64_t inputs = file.shape("photo.features")[1];
    const std::span<const float> light = file.values<float>("photo.light", {-1, -1, 3});
    const std::int64_t count = file.shape("photo.features")[0];
    const std::int64_t cells = file.shape("photo.light")[1];
    if (file.shape("photo.light")[0] != count)
      throw Error(ExitCode::kInput, path.string() + " has more lights than photos, or fewer. Make it again.");
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
    for (std::int64_t i = 0; i < count; ++i) {
      photos.push_back({Eigen::Map<const Eigen::VectorXf>(features.data() + i * inputs, inputs),
                        Eigen::Map<const Rows>(light.data() + i * cells * 3, cells, 3)});
    }
  }
  return photos;
}

}  // namespace faceprobe::synth
