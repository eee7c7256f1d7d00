#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/synth/shard.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

using io::Half;
using io::MappedTensors;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(ExitCode::kInput, file.string() + " is not the index of a data set: " + what +
                                    ". Name a folder that `faceprobe synth` wrote.");
}

nlohmann::json read_index(const std::filesystem::path& path) {
  constexpr std::int64_t kMaxBytes = 256 << 20;
  const std::vector<std::byte> bytes = io::read_file(path, kMaxBytes);
  const char* text = reinterpret_cast<const char*>(bytes.data());
  nlohmann::json index = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
  if (!index.is_object() || !index.contains("shards") || !index["shards"].is_array())
    refuse(path, "it lists no shards");
  return index;
}

// One item of an array of pictures, as an Image.
Image image_of(const MappedTensors& file, const std::string& name, int item, int channels) {
  const std::vector<std::int64_t>& shape = file.shape(name);
  const auto height = static_cast<int>(shape.at(1));
  const auto width = static_cast<int>(shape.at(2));
  Image image(width, height, channels);
  const std::span<const Half> all = file.values<Half>(name, shape);
  const std::size_t size = image.values().size();
  io::to_float(all.subspan(static_cast<std::size_t>(item) * size, size), image.values());
  return image;
}

ByteImage bytes_of(const MappedTensors& file, const std::string& name, int item, int channels) {
  const std::vector<std::int64_t>& shape = file.shape(name);
  ByteImage image(static_cast<int>(shape.at(2)), static_cast<int>(shape.at(1)), channels);
  const std::span<const std::uint8_t> all = file.values<std::uint8_t>(name, shape);
  const std::size_t size = image.values().size();
  std::ranges::copy(all.subspan(static_cast<std::size_t>(item) * size, size), image.values().begin());
  return image;
}

std::span<const float> floats_of(const MappedTensors& file, const std::string& name, int item) {
  const std::vector<std::int64_t>& shape = file.shape(name);
  std::size_t size = 1;
  for (std::size_t axis = 1; axis < shape.size(); ++axis) size *= static_cast<std::size_t>(shape[axis]);
  return file.values<float>(name, shape).subspan(static_cast<std::size_t>(item) * size, size);
}

template <class Matrix>
Matrix matrix_of(std::span<const float> values, Eigen::Index columns) {
  Matrix matrix(static_cast<Eigen::Index>(values.size()) / columns, columns);
  for (std::size_t i = 0; i < values.size(); ++i) {
    matrix(static_cast<Eigen::Index>(i) / columns, static_cast<Eigen::Index>(i) % columns) = values[i];
  }
  return matrix;
}

std::vector<NearLight> lamps_of(std::span<const float> rows) {
  std::vector<NearLight> lamps;
  for (std::size_t at = 0; at + 7 <= rows.size(); at += 7) {
    const float* row = rows.data() + at;
    if (row[3] > 0) lamps.push_back({{row[0], row[1], row[2]}, row[3], {row[4], row[5], row[6]}});
  }
  return lamps;
}

// Face number `at` of all in the file (view x faces per view + face).
FaceMarks face_of(const MappedTensors& file, std::size_t at) {
  const auto part = [&](const char* name) {
    const std::vector<std::int64_t>& shape = file.shape(name);
    std::size_t size = 1;
    for (std::size_t axis = 2; axis < shape.size(); ++axis) size *= static_cast<std::size_t>(shape[axis]);
    return file.values<float>(name, shape).subspan(at * size, size);
  };
  FaceMarks face;
  face.landmarks_px = matrix_of<Eigen::MatrixX2f>(part("view.landmarks68"), 2);
  face.dense_landmarks_px = matrix_of<Eigen::MatrixX2f>(part("view.landmarks_dense"), 2);
  face.camera_from_head.matrix() = matrix_of<Eigen::MatrixXf>(part("view.camera_from_head"), 4);
  face.identity = matrix_of<Eigen::MatrixXf>(part("view.identity"), 1);
  face.expression = matrix_of<Eigen::MatrixXf>(part("view.expression"), 1);
  face.person = file.values<std::int32_t>("view.person", {-1, -1})[at];
  return face;
}

}  // namespace

ShardReader::ShardReader(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "index.json";
  const nlohmann::json index = read_index(path);
  if (index.contains("recipe")) recipe_ = index["recipe"].dump();
  for (const nlohmann::json& shard : index["shards"]) {
    if (!shard.is_object() || !shard.contains("file") || !shard["file"].is_string())
      refuse(path, "a shard has no file name");
    const std::filesystem::path name = shard["file"].get<std::string>();
    if (name != name.filename()) refuse(path, "a shard lies in another folder");
    shards_.emplace_back(folder / name);
    const std::int64_t count = shards_.back().shape("sample.photo").at(0);
    for (std::int64_t i = 0; i < count; ++i)
      place_.emplace_back(static_cast<int>(shards_.size()) - 1, static_cast<int>(i));
  }
  for (std::size_t i = 0; i < shards_.size(); ++i) {
    const std::filesystem::path mesh = folder / mesh_name(static_cast<int>(i));
    if (!std::filesystem::exists(mesh)) break;
    meshes_.emplace_back(mesh);
    if (meshes_.back().shape("view.mesh_region").at(0) != shards_[i].shape("view.person").at(0))
      throw Error(ExitCode::kInput, mesh.string() + " is of another shard. Run `faceprobe mesh` again.");
  }
  if (meshes_.size() != shards_.size()) meshes_.clear();
}

ShardReader::ShardReader(const std::vector<std::filesystem::path>& folders) {
  if (folders.empty()) throw std::invalid_argument("A data set needs a folder.");
  nlohmann::json recipes = nlohmann::json::array();
  bool all_meshes = true;
  for (const std::filesystem::path& folder : folders) {
    ShardReader one(folder);
    recipes.push_back(one.recipe_.empty() ? nlohmann::json() : nlohmann::json::parse(one.recipe_));
    const auto first = static_cast<int>(shards_.size());
    for (const auto& [shard, number] : one.place_) place_.emplace_back(first + shard, number);
    std::ranges::move(one.shards_, std::back_inserter(shards_));
    all_meshes = all_meshes && one.has_meshes();
    std::ranges::move(one.meshes_, std::back_inserter(meshes_));
  }
  if (!all_meshes) meshes_.clear();
  recipe_ = recipes.dump();
}

std::pair<const MappedTensors*, int> ShardReader::place(int sample) const {
  const auto& [shard, number] = place_.at(static_cast<std::size_t>(sample));
  return {&shards_[static_cast<std::size_t>(shard)], number};
}

Sample ShardReader::copy_light(int number) const {
  const auto [file, at] = place(number);
  Sample sample;
  sample.photo = bytes_of(*file, "sample.photo", at, 3);
  sample.clip = bytes_of(*file, "sample.clip", at, 1);
  sample.highlight = image_of(*file, "sample.highlight", at, 3);
  sample.diffuse = image_of(*file, "sample.diffuse", at, 3);
  return sample;
}

Sample ShardReader::copy_sample(int number) const {
  const auto [file, at] = place(number);
  Sample sample = copy_light(number);
  sample.albedo = image_of(*file, "sample.albedo", at, 3);
  sample.shading = image_of(*file, "sample.shading", at, 3);
  sample.environment = EnvMap(image_of(*file, "sample.environment", at, 3));
  const auto index = static_cast<std::size_t>(at);
  sample.map = file->values<std::int32_t>("sample.map", {-1})[index];
  sample.map_yaw = file->values<float>("sample.map_yaw", {-1})[index];
  if (file->has("sample.lamps")) sample.lamps = lamps_of(floats_of(*file, "sample.lamps", at));
  const std::span<const std::int64_t> begin = file->values<std::int64_t>("sample.settings_begin", {-1});
  const std::span<const std::uint8_t> text = file->values<std::uint8_t>("sample.settings", {-1});
  const auto first = static_cast<std::size_t>(begin[index]);
  const auto last = static_cast<std::size_t>(begin[index + 1]);
  if (first <= last && last <= text.size())
    sample.settings_json.assign(text.begin() + begin[index], text.begin() + begin[index + 1]);
  return sample;
}

int ShardReader::view_of(int number) const {
  const auto [file, sample] = place(number);
  const int at = file->values<std::int32_t>("sample.view", {-1})[static_cast<std::size_t>(sample)];
  if (at < 0 || at >= file->shape("view.person").at(0)) {
    throw Error(ExitCode::kInput, "Sample " + std::to_string(number) +
                                      " names a view that is not there: the shard is damaged. Make it again.");
  }
  return at;
}

int ShardReader::person(int number) const {
  const io::MappedTensors* file = place(number).first;
  const auto faces = static_cast<std::size_t>(file->shape("view.person").at(1));
  const std::span<const std::int32_t> person = file->values<std::int32_t>("view.person", {-1, -1});
  return faces == 0 ? -1 : person[static_cast<std::size_t>(view_of(number)) * faces];
}

std::pair<int, int> ShardReader::view_place(int number) const {
  return {place_.at(static_cast<std::size_t>(number)).first, view_of(number)};
}

FoundMesh ShardReader::copy_mesh(int number) const {
  const auto [shard, view] = view_place(number);
  const MappedTensors& file = meshes_.at(static_cast<std::size_t>(shard));
  return {image_of(file, "view.mesh_normal", view, 3), bytes_of(file, "view.mesh_region", view, 1)};
}

ViewLayers ShardReader::copy_view(int number) const {
  const io::MappedTensors* file = place(number).first;
  const int at = view_of(number);
  ViewLayers view = copy_faces(number);
  view.normal = image_of(*file, "view.normal", at, 3);
  view.depth_m = image_of(*file, "view.depth", at, 1);
  return view;
}

ViewLayers ShardReader::copy_faces(int number) const {
  const io::MappedTensors* file = place(number).first;
  const int at = view_of(number);
  ViewLayers view;
  view.region = bytes_of(*file, "view.region", at, 1);
  view.owner = bytes_of(*file, "view.owner", at, 1);
  const std::span<const float> camera = floats_of(*file, "view.camera", at);
  view.focal_px = camera[0];
  view.centre_px = {camera[1], camera[2]};
  const auto faces = static_cast<std::size_t>(file->shape("view.person").at(1));
  const std::span<const std::int32_t> person = file->values<std::int32_t>("view.person", {-1, -1});
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t face = static_cast<std::size_t>(at) * faces + f;
    if (person[face] >= 0) view.faces.push_back(face_of(*file, face));
  }
  return view;
}

}  // namespace faceprobe::synth
