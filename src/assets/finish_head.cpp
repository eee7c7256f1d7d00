#include "assets/finish_head.h"

#include "assets/array.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/data_files.h"

#include <Eigen/Geometry>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <utility>

namespace faceprobe::assets {

void set_encoded_albedo(synth::HeadModel& model, Eigen::MatrixX3f mean) { model.vertex_albedo = std::move(mean); }

void add_encoded_albedo_mode(synth::HeadModel& model, Eigen::MatrixX3f mode) {
  model.albedo_modes.push_back(std::move(mode));
}

void finish_albedo(synth::HeadModel& model) {
  constexpr float kStep = 0.5F / 255;
  const Eigen::MatrixX3f encoded = model.vertex_albedo.cwiseMax(0.0F).cwiseMin(1.0F);
  const Eigen::MatrixX3f slope = encoded.unaryExpr(
      [](float value) { return (linear_from_srgb(value + kStep) - linear_from_srgb(value - kStep)) / (2 * kStep); });
  model.vertex_albedo = encoded.unaryExpr([](float value) { return linear_from_srgb(value); });
  for (Eigen::MatrixX3f& mode : model.albedo_modes) mode = mode.cwiseProduct(slope);
}

void turn_outwards(synth::HeadModel& model) {
  // Volume between the surface and its middle; for an open face as well, since it bends around its middle.
  const Eigen::RowVector3f middle = model.neutral.colwise().mean();
  double volume = 0;
  for (const auto& t : model.triangles.rowwise()) {
    const Eigen::Vector3f a = (model.neutral.row(t(0)) - middle).transpose();
    const Eigen::Vector3f b = (model.neutral.row(t(1)) - middle).transpose();
    const Eigen::Vector3f c = (model.neutral.row(t(2)) - middle).transpose();
    volume += static_cast<double>(a.dot(b.cross(c)));
  }
  if (volume < 0) model.triangles.col(1).swap(model.triangles.col(2));
  if (volume < 0 && model.triangle_uv.rows() > 0) model.triangle_uv.col(1).swap(model.triangle_uv.col(2));
}

void make_all_skin(synth::HeadModel& model) {
  model.triangle_material.assign(static_cast<std::size_t>(model.triangles.rows()), synth::Material::kSkin);
}

void read_landmarks_beside(const std::filesystem::path& path, synth::HeadModel& model) {
  std::filesystem::path list = path;
  list.replace_extension(".landmarks.txt");
  if (!std::filesystem::exists(list)) return;
  const std::vector<std::byte> bytes = io::read_file(list, 1 << 20);
  const char* at = reinterpret_cast<const char*>(bytes.data());
  const char* end = at + bytes.size();
  constexpr std::string_view kBetween = " \t\r\n,";
  while (true) {
    while (at < end && kBetween.find(*at) != std::string_view::npos) ++at;
    if (at == end) break;
    int vertex = 0;
    const auto [next, fault] = std::from_chars(at, end, vertex);
    if (fault != std::errc() || vertex < 0 || vertex >= model.neutral.rows()) {
      refuse_input(quoted(list) + " holds something other than vertex numbers from 0 to " +
                   std::to_string(model.neutral.rows() - 1) + " after its first " +
                   std::to_string(model.landmarks.size()) + ".");
    }
    model.landmarks.push_back(vertex);
    at = next;
  }
  if (model.landmarks.size() != 68) {
    refuse_input(quoted(list) + " holds " + std::to_string(model.landmarks.size()) + " vertex numbers; 68 are needed.");
  }
}

void move_origin_between_eyes(synth::HeadModel& model) {
  Eigen::RowVector3f middle = Eigen::RowVector3f::Zero();
  if (model.landmarks.size() == 68) {
    for (std::size_t i = 36; i < 48; ++i) middle += model.neutral.row(model.landmarks[i]) / 12.0F;
  } else {
    Eigen::Index tip = 0;
    model.neutral.col(2).maxCoeff(&tip);
    middle = model.neutral.row(tip) + Eigen::RowVector3f(0, 0.043F, -0.035F);
  }
  model.neutral.rowwise() -= middle;
}

void require_valid(const synth::HeadModel& model, const std::string& file) {
  const std::string fault = model.validate();
  if (!fault.empty()) refuse_input(file + " cannot be used. " + fault);
}

}  // namespace faceprobe::assets
