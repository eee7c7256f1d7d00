#include "train/regressor_data.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/net/face_window.h"
#include "faceprobe/synth/photo_layers.h"
#include "faceprobe/synth/shard.h"
#include "faceprobe/train/map_crops.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <optional>

namespace faceprobe::train {
namespace {

using RowCells = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
using CellsFromTexels = Eigen::SparseMatrix<float, Eigen::RowMajor>;

constexpr float kDarkestLight = 1e-4F;  // of white

RegressorExamples room_for(std::int64_t count, const RegressorConfig& config, std::int64_t points) {
  return {torch::empty({count, config.picture_px, config.picture_px, 3}, torch::kByte),
          torch::empty({count, points, 3})};
}

void put_example(const ByteImage& picture, const float* light, std::int64_t at, const RegressorExamples& to) {
  const std::int64_t bytes = to.picture[0].numel();
  const std::int64_t numbers = to.light[0].numel();
  std::copy_n(picture.data(), bytes, to.picture.data_ptr<std::uint8_t>() + at * bytes);
  std::transform(light, light + numbers, to.light.data_ptr<float>() + at * numbers,
                 [](float value) { return std::max(value, kDarkestLight); });
}

MapCropOptions drawn_view(Random random, const RegressorConfig& config) {
  constexpr double kPitch = 0.12;                             // standard deviation, radians
  constexpr double kNarrowest = 0.7, kWidest = 1.4;           // radians
  constexpr double kDarkestView = 0.6, kBrightestView = 1.6;  // of the usual exposure
  MapCropOptions view;
  view.px = config.picture_px;
  view.field_of_view_rad = static_cast<float>(random.between(kNarrowest, kWidest));
  view.yaw_rad = static_cast<float>(random.between(-kPi, kPi));
  view.pitch_rad = static_cast<float>(random.normal(0, kPitch));
  view.exposure = static_cast<float>(random.log_between(kDarkestView, kBrightestView));
  return view;
}

bool lit_by_lamps(const io::MappedTensors& file, std::size_t at) {
  if (!file.has("sample.lamps")) return false;
  const std::size_t size = static_cast<std::size_t>(file.shape("sample.lamps").at(1)) * 7;
  const std::span<const float> rows = file.values<float>("sample.lamps", {-1, -1, 7}).subspan(at * size, size);
  for (std::size_t i = 3; i < size; i += 7) {
    if (rows[i] > 0) return true;  // a radius: there is a lamp
  }
  return false;
}

ByteImage photo_of(const io::MappedTensors& file, std::size_t at) {
  const std::vector<std::int64_t>& shape = file.shape("sample.photo");
  ByteImage photo(static_cast<int>(shape.at(2)), static_cast<int>(shape.at(1)), 3);
  const std::size_t size = photo.values().size();
  std::ranges::copy(file.values<std::uint8_t>("sample.photo", {-1, -1, -1, 3}).subspan(at * size, size),
                    photo.values().begin());
  return photo;
}

// What grid_from_env_map does to every map of one size, as a matrix: there are thousands of them. Three texels are seen at a time, one by each
// channel.
CellsFromTexels cells_from_texels(int height, const SphereGrid& grid) {
  const int texels = 2 * height * height;
  std::vector<Eigen::Triplet<float>> entries;
  for (int first = 0; first < texels; first += 3) {
    EnvMap map(2 * height, height);
    const int count = std::min(3, texels - first);
    for (int c = 0; c < count; ++c) map.radiance().data()[3 * (first + c) + c] = 1;
    const Eigen::MatrixX3f cells = grid_from_env_map(map, grid);
    for (int c = 0; c < count; ++c) {
      for (int j = 0; j < grid.cell_count(); ++j) {
        if (cells(j, c) != 0) entries.emplace_back(j, first + c, cells(j, c));
      }
    }
  }
  CellsFromTexels matrix(grid.cell_count(), texels);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

RowCells light_of(const io::MappedTensors& file, std::size_t at, const CellsFromTexels& cells) {
  const std::vector<std::int64_t>& shape = file.shape("sample.environment");
  RowCells texels(cells.cols(), 3);
  if (shape.at(1) * shape.at(2) != cells.cols())
    throw Error(ExitCode::kInput, "The maps of the faces are of several sizes: the folder is damaged. Make it again.");
  const auto size = static_cast<std::size_t>(texels.size());
  io::to_float(file.values<io::Half>("sample.environment", {-1, -1, -1, 3}).subspan(at * size, size),
               {texels.data(), size});
  return cells * texels;
}

// False: no usable face. Only what is needed is read: a sample's layers are ten times as many bytes.
bool put_face(const synth::ShardReader& faces, int number, const CellsFromTexels& cells, std::int64_t at,
              const RegressorExamples& to) {
  const auto [file, index] = faces.place(number);
  const auto sample = static_cast<std::size_t>(index);
  if (lit_by_lamps(*file, sample)) return false;  // no one map lights it
  const ByteImage mask =
      faces.has_meshes() ? faces.copy_mesh(number).region : synth::face_mask(faces.copy_faces(number), 1);
  const std::optional<Window> window = net::face_window(mask, static_cast<int>(to.picture.size(1)));
  if (!window) return false;
  const ByteImage picture = encode_srgb(resampled(decode_srgb(photo_of(*file, sample)), *window, Outside::kEdge));
  const RowCells light = light_of(*file, sample, cells);
  if (!light.allFinite()) {
    throw Error(ExitCode::kInput, "The light of sample " + std::to_string(number) +
                                      " holds NaN or infinity: the shard is damaged. Make it again.");
  }
  put_example(picture, light.data(), at, to);
  return true;
}

}  // namespace

RegressorExamples crop_examples(const std::vector<EnvMap>& maps, int count, std::uint64_t key,
                                const RegressorConfig& config, int threads) {
  const std::int64_t points = 2 * config.light_size * config.light_size;
  const RegressorExamples out = room_for(count, config, points);
  parallel_for(count, threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const EnvMap& map = maps[static_cast<std::size_t>(i) % maps.size()];
      const MapCropOptions view = drawn_view(Random({config.seed, key, static_cast<std::uint64_t>(i)}), config);
      const EnvMap light = resize(map_of_crop(map, view), 2 * config.light_size, config.light_size);
      put_example(encode_srgb(crop_of_map(map, view)), light.radiance().data(), i, out);
    }
  });
  return out;
}

RegressorExamples face_examples(const std::filesystem::path& folder, int most, const RegressorConfig& config,
                                int threads) {
  const synth::ShardReader faces(folder);
  const SphereGrid grid(config.light_size);
  const int taken = std::min(most, faces.sample_count());
  CellsFromTexels cells;
  if (taken > 0)
    cells = cells_from_texels(static_cast<int>(faces.place(0).first->shape("sample.environment").at(1)), grid);
  RegressorExamples out = room_for(taken, config, grid.cell_count());
  torch::Tensor found = torch::zeros({taken}, torch::kBool);
  parallel_for(taken, threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const auto number = static_cast<int>(static_cast<long long>(i) * faces.sample_count() / taken);
      found.data_ptr<bool>()[i] = put_face(faces, number, cells, i, out);
    }
  });
  const std::int64_t count = found.sum().item<std::int64_t>();
  if (count == 0) {
    throw Error(ExitCode::kInput, "There is no face under a map in " + folder.string() +
                                      ". Name a folder that `faceprobe synth` wrote, of single people.");
  }
  if (count == taken) return out;
  const torch::Tensor kept = found.nonzero().squeeze(1);
  return {out.picture.index_select(0, kept), out.light.index_select(0, kept)};
}

}  // namespace faceprobe::train
