#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/synth/shard.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

namespace faceprobe::synth {
namespace {

using Shape = std::vector<std::int64_t>;
using io::Half;

constexpr int kFormat = 2;
constexpr const char* kRecipeFile = "recipe.json";

void put_half(const Image& image, std::span<Half> all, std::size_t item) {
  const std::size_t size = image.values().size();
  io::to_half(image.values(), all.subspan(item * size, size));
}

void put_bytes(const ByteImage& image, std::span<std::uint8_t> all, std::size_t item) {
  std::ranges::copy(image.values(), all.begin() + static_cast<std::ptrdiff_t>(item * image.values().size()));
}

// Row-major, cut or padded with zeros to the length of an item.
template <class Matrix>
void put_rows(const Matrix& matrix, std::span<float> all, std::size_t item, std::size_t length) {
  std::size_t at = item * length;
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) all[at++] = matrix(row, column);
  }
}

// How long the longest list of each kind is; shorter ones are filled up with zeros.
struct FaceSizes {
  std::size_t faces = 1, marks = 0, dense = 0, identity = 0, expression = 0;
};

FaceSizes sizes_of(std::span<const ViewSamples> views) {
  const auto grow = [](std::size_t& size, Eigen::Index length) {
    size = std::max(size, static_cast<std::size_t>(length));
  };
  FaceSizes sizes;
  for (const ViewSamples& v : views) {
    grow(sizes.faces, static_cast<Eigen::Index>(v.view.faces.size()));
    for (const FaceMarks& face : v.view.faces) {
      grow(sizes.marks, face.landmarks_px.rows());
      grow(sizes.dense, face.dense_landmarks_px.rows());
      grow(sizes.identity, face.identity.size());
      grow(sizes.expression, face.expression.size());
    }
  }
  return sizes;
}

Shape shape(std::initializer_list<std::size_t> lengths) {
  Shape result;
  for (const std::size_t length : lengths) result.push_back(static_cast<std::int64_t>(length));
  return result;
}

void add_faces(std::span<const ViewSamples> views, io::TensorFileBuilder& file) {
  const FaceSizes size = sizes_of(views);
  const std::size_t count = views.size();
  const auto landmarks = file.add<float>("view.landmarks68", shape({count, size.faces, size.marks, 2}));
  const auto dense = file.add<float>("view.landmarks_dense", shape({count, size.faces, size.dense, 2}));
  const auto pose = file.add<float>("view.camera_from_head", shape({count, size.faces, 4, 4}));
  const auto identities = file.add<float>("view.identity", shape({count, size.faces, size.identity}));
  const auto expressions = file.add<float>("view.expression", shape({count, size.faces, size.expression}));
  const auto person = file.add<std::int32_t>("view.person", shape({count, size.faces}));
  std::ranges::fill(person, -1);
  for (std::size_t v = 0; v < count; ++v) {
    for (std::size_t f = 0; f < views[v].view.faces.size(); ++f) {
      const FaceMarks& face = views[v].view.faces[f];
      const std::size_t at = v * size.faces + f;
      put_rows(face.landmarks_px, landmarks, at, 2 * size.marks);
      put_rows(face.dense_landmarks_px, dense, at, 2 * size.dense);
      put_rows(face.camera_from_head.matrix(), pose, at, 16);
      put_rows(face.identity, identities, at, size.identity);
      put_rows(face.expression, expressions, at, size.expression);
      person[at] = face.person;
    }
  }
}

void add_views(std::span<const ViewSamples> views, int size_px, io::TensorFileBuilder& file) {
  const auto count = static_cast<std::int64_t>(views.size());
  const auto normal = file.add<Half>("view.normal", {count, size_px, size_px, 3});
  const auto depth = file.add<Half>("view.depth", {count, size_px, size_px});
  const auto region = file.add<std::uint8_t>("view.region", {count, size_px, size_px});
  const auto owner = file.add<std::uint8_t>("view.owner", {count, size_px, size_px});
  const auto camera = file.add<float>("view.camera", {count, 3});
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ViewLayers& view = views[v].view;
    put_half(view.normal, normal, v);
    put_half(view.depth_m, depth, v);
    put_bytes(view.region, region, v);
    put_bytes(view.owner, owner, v);
    put_rows(Eigen::RowVector3f(view.focal_px, view.centre_px.x(), view.centre_px.y()), camera, v, 3);
  }
  add_faces(views, file);
}

// Rows of position, radius, radiance; a radius of 0 marks a row that is no lamp.
void add_lamps(std::span<const ViewSamples> views, std::size_t samples, io::TensorFileBuilder& file) {
  std::size_t most = 0;
  for (const ViewSamples& view : views) {
    for (const Sample& sample : view.samples) most = std::max(most, sample.lamps.size());
  }
  if (most == 0) return;
  const auto lamps = file.add<float>("sample.lamps", shape({samples, most, 7}));
  std::size_t s = 0;
  for (const ViewSamples& view : views) {
    for (const Sample& sample : view.samples) {
      for (std::size_t l = 0; l < sample.lamps.size(); ++l) {
        const NearLight& lamp = sample.lamps[l];
        Eigen::Matrix<float, 1, 7> row;
        row << lamp.position.transpose(), lamp.radius, lamp.radiance.transpose();
        put_rows(row, lamps, s * most + l, 7);
      }
      ++s;
    }
  }
}

void add_samples(std::span<const ViewSamples> views, const ShardSpec& spec, io::TensorFileBuilder& file) {
  std::int64_t count = 0;
  std::string settings;
  std::vector<std::int64_t> settings_begin = {0};
  for (const ViewSamples& view : views) {
    count += static_cast<std::int64_t>(view.samples.size());
    for (const Sample& sample : view.samples) {
      settings += sample.settings_json;
      settings_begin.push_back(static_cast<std::int64_t>(settings.size()));
    }
  }
  const std::int64_t size = spec.size_px;
  const std::int64_t height = spec.environment_height;
  const auto photo = file.add<std::uint8_t>("sample.photo", {count, size, size, 3});
  const auto clip = file.add<std::uint8_t>("sample.clip", {count, size, size});
  const auto highlight = file.add<Half>("sample.highlight", {count, size, size, 3});
  const auto diffuse = file.add<Half>("sample.diffuse", {count, size, size, 3});
  const auto albedo = file.add<Half>("sample.albedo", {count, size, size, 3});
  const auto shading = file.add<Half>("sample.shading", {count, size, size, 3});
  const auto environment = file.add<Half>("sample.environment", {count, height, 2 * height, 3});
  const auto of_view = file.add<std::int32_t>("sample.view", {count});
  const auto map = file.add<std::int32_t>("sample.map", {count});
  const auto map_yaw = file.add<float>("sample.map_yaw", {count});
  const auto text = file.add<std::uint8_t>("sample.settings", {static_cast<std::int64_t>(settings.size())});
  const auto text_begin = file.add<std::int64_t>("sample.settings_begin", {count + 1});
  if (!settings.empty()) std::memcpy(text.data(), settings.data(), settings.size());
  std::ranges::copy(settings_begin, text_begin.begin());
  add_lamps(views, static_cast<std::size_t>(count), file);
  std::size_t s = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const Sample& sample : views[v].samples) {
      put_bytes(sample.photo, photo, s);
      put_bytes(sample.clip, clip, s);
      put_half(sample.highlight, highlight, s);
      put_half(sample.diffuse, diffuse, s);
      put_half(sample.albedo, albedo, s);
      put_half(sample.shading, shading, s);
      put_half(sample.environment.radiance(), environment, s);
      of_view[s] = static_cast<std::int32_t>(v);
      map[s] = sample.map;
      map_yaw[s] = sample.map_yaw;
      ++s;
    }
  }
}

std::string read_text(const std::filesystem::path& path) {
  constexpr std::int64_t kMaxBytes = 64 << 20;
  const std::vector<std::byte> bytes = io::read_file(path, kMaxBytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// "seed is 1 there and 2 here", of the first key that differs.
std::string difference(const std::string& there, const std::string& here) {
  const nlohmann::json old = nlohmann::json::parse(there, nullptr, false);
  const nlohmann::json wanted = nlohmann::json::parse(here, nullptr, false);
  if (!old.is_object() || !wanted.is_object()) return "its recipe is damaged";
  constexpr std::size_t kLongest = 60;
  for (const auto& [key, value] : wanted.items()) {
    if (old.contains(key) && old[key] == value) continue;
    const std::string before = old.contains(key) ? old[key].dump() : "not given";
    if (before.size() > kLongest || value.dump().size() > kLongest) return key + " differ";
    std::string text = key;
    return text.append(" is ").append(before).append(" there and ").append(value.dump()).append(" here");
  }
  return "its recipe says more than this one";
}

// Files of a run that was killed while it wrote: they begin with a dot and end like a shard.
void remove_leftovers(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> leftovers;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".shard-") && name.ends_with(".tmp.safetensors")) leftovers.push_back(entry.path());
  }
  for (const std::filesystem::path& path : leftovers) std::filesystem::remove(path, ignored);
}

}  // namespace

std::string shard_name(int shard) {
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "shard-%05d.safetensors", shard);
  return name.data();
}

std::string mesh_name(int shard) { return "mesh" + shard_name(shard).substr(std::string("shard").size()); }

void write_meshes(const std::filesystem::path& folder, int shard, std::span<const FoundMesh> views) {
  io::TensorFileBuilder file;
  const std::size_t height = views.empty() ? 0 : static_cast<std::size_t>(views[0].region.height());
  const std::size_t width = views.empty() ? 0 : static_cast<std::size_t>(views[0].region.width());
  const auto normal = file.add<Half>("view.mesh_normal", shape({views.size(), height, width, 3}));
  const auto region = file.add<std::uint8_t>("view.mesh_region", shape({views.size(), height, width}));
  for (std::size_t v = 0; v < views.size(); ++v) {
    put_half(views[v].normal_cam, normal, v);
    put_bytes(views[v].region, region, v);
  }
  file.write(folder / mesh_name(shard));
}

ShardWriter::ShardWriter(std::filesystem::path folder, ShardSpec spec)
    : folder_(std::move(folder)), spec_(std::move(spec)) {
  io::create_folder(folder_);
  const std::filesystem::path recipe = folder_ / kRecipeFile;
  if (std::filesystem::exists(recipe)) {
    const std::string there = read_text(recipe);
    if (there != spec_.recipe) {
      throw Error(ExitCode::kOutput, folder_.string() +
                                         " holds samples of another recipe: " + difference(there, spec_.recipe) +
                                         ". Choose another folder, or remove this one.");
    }
  }
  remove_leftovers(folder_);
  io::write_file_atomically(recipe, spec_.recipe);
}

// A shard appears under its name only when it is complete.
bool ShardWriter::has(int shard) const { return std::filesystem::exists(folder_ / shard_name(shard)); }

void ShardWriter::write(int shard, std::span<const ViewSamples> views) const {
  io::TensorFileBuilder file;
  file.set_metadata("format", std::string("faceprobe synth ").append(std::to_string(kFormat)));
  add_samples(views, spec_, file);
  add_views(views, spec_.size_px, file);
  file.write(folder_ / shard_name(shard));
}

void ShardWriter::finish(int shard_count, const std::string& card_markdown) const {
  nlohmann::ordered_json shards = nlohmann::ordered_json::array();
  std::int64_t samples = 0;
  for (int shard = 0; shard < shard_count; ++shard) {
    const io::MappedTensors file(folder_ / shard_name(shard));
    const std::int64_t count = file.shape("sample.photo").at(0);
    shards.push_back({{"file", shard_name(shard)}, {"samples", count}, {"views", file.shape("view.person").at(0)}});
    samples += count;
  }
  const nlohmann::ordered_json index = {
      {"format", kFormat},        {"samples", samples},
      {"size_px", spec_.size_px}, {"environment_height", spec_.environment_height},
      {"shards", shards},         {"recipe", nlohmann::ordered_json::parse(spec_.recipe)},
  };
  io::write_file_atomically(folder_ / "CARD.md", card_markdown);
  io::write_file_atomically(folder_ / "index.json", index.dump(1));
}

}  // namespace faceprobe::synth
