#include "synth/assets/asset_head.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

using io::Half;
using Shape = std::vector<std::int64_t>;
template <class T, int Columns>
using Rows = Eigen::Matrix<T, Eigen::Dynamic, Columns, Eigen::RowMajor>;

template <class T, int Columns>
void put_rows(const Eigen::Matrix<T, Eigen::Dynamic, Columns>& matrix, const std::string& name,
              io::TensorFileBuilder& file) {
  const std::span<T> to = file.add<T>(name, {matrix.rows(), Columns});
  Eigen::Map<Rows<T, Columns>>(to.data(), matrix.rows(), Columns) = matrix;
}

template <class T, int Columns>
Eigen::Matrix<T, Eigen::Dynamic, Columns> rows_from(const io::MappedTensors& file, const std::string& name) {
  const std::span<const T> from = file.values<T>(name, {-1, Columns});
  return Eigen::Map<const Rows<T, Columns>>(from.data(), static_cast<Eigen::Index>(from.size() / Columns), Columns);
}

// Modes of the first vertices are filled up with zeros to the longest of them.
void put_modes(const std::vector<Eigen::MatrixX3f>& modes, const std::string& name, io::TensorFileBuilder& file) {
  Eigen::Index longest = 0;
  for (const Eigen::MatrixX3f& mode : modes) longest = std::max(longest, mode.rows());
  const std::span<Half> to = file.add<Half>(name, {static_cast<std::int64_t>(modes.size()), longest, 3});
  const std::size_t length = static_cast<std::size_t>(longest) * 3;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Rows<float, 3> rows = modes[i];
    io::to_half({rows.data(), static_cast<std::size_t>(rows.size())},
                to.subspan(i * length, static_cast<std::size_t>(rows.size())));
  }
}

std::vector<Eigen::MatrixX3f> modes_from(const io::MappedTensors& file, const std::string& name) {
  const std::span<const Half> from = file.values<Half>(name, {-1, -1, 3});
  const Shape shape = file.shape(name);
  const std::size_t length = static_cast<std::size_t>(shape[1]) * 3;
  std::vector<Eigen::MatrixX3f> modes;
  for (std::int64_t i = 0; i < shape[0]; ++i) {
    Rows<float, 3> rows(shape[1], 3);
    io::to_float(from.subspan(static_cast<std::size_t>(i) * length, length), {rows.data(), length});
    modes.emplace_back(rows);
  }
  return modes;
}

// Values of an enumeration that is stored as a byte.
template <class E>
void put_bytes(const std::vector<E>& values, const std::string& name, io::TensorFileBuilder& file) {
  const std::span<std::uint8_t> to = file.add<std::uint8_t>(name, {static_cast<std::int64_t>(values.size())});
  std::ranges::transform(values, to.begin(), [](E value) { return static_cast<std::uint8_t>(value); });
}

template <class E>
std::vector<E> bytes_from(const io::MappedTensors& file, const std::string& name, int count) {
  std::vector<E> values;
  for (const std::uint8_t value : file.values<std::uint8_t>(name, {-1})) {
    if (value >= count) throw std::out_of_range(name + " holds the number " + std::to_string(value));
    values.push_back(static_cast<E>(value));
  }
  return values;
}

void put_dense(const std::vector<SurfacePoint>& points, const std::string& prefix, io::TensorFileBuilder& file) {
  const auto count = static_cast<std::int64_t>(points.size());
  const std::span<std::int32_t> triangles = file.add<std::int32_t>(prefix + "dense_triangle", {count});
  const std::span<float> weights = file.add<float>(prefix + "dense_weights", {count, 3});
  for (std::size_t i = 0; i < points.size(); ++i) {
    triangles[i] = points[i].triangle;
    Eigen::Map<Eigen::Vector3f>(weights.data() + 3 * i) = points[i].weights;
  }
}

std::vector<SurfacePoint> dense_from(const io::MappedTensors& file, const std::string& prefix) {
  const std::span<const std::int32_t> triangles = file.values<std::int32_t>(prefix + "dense_triangle", {-1});
  const std::span<const float> weights =
      file.values<float>(prefix + "dense_weights", {static_cast<std::int64_t>(triangles.size()), 3});
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    points.push_back({triangles[i], Eigen::Map<const Eigen::Vector3f>(weights.data() + 3 * i)});
  }
  return points;
}

constexpr int kUvLayouts = 3;
constexpr int kMaterials = static_cast<int>(Material::kObject) + 1;

}  // namespace

nlohmann::json put_head(const HeadModel& model, const std::string& prefix, io::TensorFileBuilder& file) {
  put_rows<float, 3>(model.neutral, prefix + "neutral", file);
  put_modes(model.identity, prefix + "identity", file);
  put_modes(model.expression, prefix + "expression", file);
  put_rows<int, 3>(model.triangles, prefix + "triangles", file);
  put_bytes(model.triangle_material, prefix + "triangle_material", file);
  put_rows<float, 2>(model.uv, prefix + "uv", file);
  put_rows<int, 3>(model.triangle_uv, prefix + "triangle_uv", file);
  put_bytes(model.vertex_region, prefix + "vertex_region", file);
  put_dense(model.dense_landmarks, prefix, file);
  put_rows<float, 3>(model.vertex_albedo, prefix + "vertex_albedo", file);
  put_modes(model.albedo_modes, prefix + "albedo_modes", file);
  if (!model.texture.empty()) {
    std::ranges::copy(model.texture.values(),
                      file.add<std::uint8_t>(prefix + "texture",
                                             {model.texture.height(), model.texture.width(), model.texture.channels()})
                          .begin());
  }
  return {{"name", model.name},
          {"expression_names", model.expression_names},
          {"landmarks", model.landmarks},
          {"uv_layout", static_cast<int>(model.uv_layout)}};
}

HeadModel head_from(const io::MappedTensors& file, const std::string& prefix, const nlohmann::json& description) {
  HeadModel model;
  model.name = description.at("name").get<std::string>();
  model.expression_names = description.at("expression_names").get<std::vector<std::string>>();
  model.landmarks = description.at("landmarks").get<std::vector<int>>();
  const int layout = description.at("uv_layout").get<int>();
  if (layout < 0 || layout >= kUvLayouts) throw std::out_of_range("its UV layout is " + std::to_string(layout));
  model.uv_layout = static_cast<UvLayout>(layout);
  model.neutral = rows_from<float, 3>(file, prefix + "neutral");
  model.identity = modes_from(file, prefix + "identity");
  model.expression = modes_from(file, prefix + "expression");
  model.triangles = rows_from<int, 3>(file, prefix + "triangles");
  model.triangle_material = bytes_from<Material>(file, prefix + "triangle_material", kMaterials);
  model.uv = rows_from<float, 2>(file, prefix + "uv");
  model.triangle_uv = rows_from<int, 3>(file, prefix + "triangle_uv");
  model.vertex_region = bytes_from<Region>(file, prefix + "vertex_region", kRegionCount);
  model.dense_landmarks = dense_from(file, prefix);
  model.vertex_albedo = rows_from<float, 3>(file, prefix + "vertex_albedo");
  model.albedo_modes = modes_from(file, prefix + "albedo_modes");
  if (file.has(prefix + "texture")) {
    const std::span<const std::uint8_t> bytes = file.values<std::uint8_t>(prefix + "texture", {-1, -1, -1});
    const Shape shape = file.shape(prefix + "texture");
    model.texture = ByteImage(static_cast<int>(shape[1]), static_cast<int>(shape[0]), static_cast<int>(shape[2]));
    std::ranges::copy(bytes, model.texture.data());
  }
  return model;
}

}  // namespace faceprobe::synth
