#include "serve/describe.h"

#include "faceprobe/pipeline/insertion.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/report.h"
#include "faceprobe/render/shapes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kMediaTypes = {{
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".exr", "image/x-exr"},
    {".hdr", "image/vnd.radiance"},
    {".json", "application/json"},
    {".gltf", "model/gltf+json"},
    {".usda", "text/plain; charset=utf-8"},
    {".py", "text/x-python; charset=utf-8"},
}};

template <class Matrix>
Json row_by_row(const Matrix& matrix) {
  Json all = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) all.push_back(matrix(row, column));
  }
  return all;
}

Json vector_json(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

Json face_json(const pipeline::FaceEstimate& face, const std::string& folder) {
  const face::Box& box = face.face.box;
  const face::Crop& crop = face.geometry.crop;
  return {{"box_px", {box.x, box.y, box.width, box.height}},
          {"crop_px", {crop.x_px, crop.y_px, crop.width / crop.scale, crop.height / crop.scale}},
          {"mesh_px", row_by_row(face.face.landmarks_px.leftCols<2>())},
          {"folder", folder}};
}

}  // namespace

std::string media_type(std::string_view path) {
  const auto* known = std::ranges::find_if(kMediaTypes, [&](const auto& type) { return path.ends_with(type.first); });
  return std::string(known == kMediaTypes.end() ? "application/octet-stream" : known->second);
}

Json files_json(const std::vector<ServedFile>& files) {
  Json all = Json::array();
  for (const ServedFile& file : files)
    all.push_back({{"path", file.path}, {"bytes", file.bytes}, {"media_type", media_type(file.path)}});
  return all;
}

Json material_json(const render::Material& material) {
  return {{"name", material.name},
          {"kind", render::material_kind_name(material.kind)},
          {"colour_rgb", vector_json(material.colour)},
          {"roughness", material.roughness},
          {"index", material.ior}};
}

Json object_json(const std::string& name, const render::Model& model) {
  Json json = {{"name", name}, {"materials", Json::array()}, {"meshes", Json::array()}};
  for (const render::Material& material : model.materials) json["materials"].push_back(material_json(material));
  for (const render::TriangleMesh& mesh : model.meshes) {
    json["meshes"].push_back({{"material", mesh.material},
                              {"positions", row_by_row(mesh.vertices)},
                              {"normals", row_by_row(mesh.normals)},
                              {"triangles", row_by_row(mesh.triangles)}});
  }
  return json;
}

Json describe(const EstimateRecord& record, const io::Photo& photo, const pipeline::EstimateOptions& options,
              const pipeline::Room* room) {
  const pipeline::Estimate& estimate = record.estimate;
  const pipeline::Spot spot = pipeline::spot_for(estimate, render::cube());
  Json faces = Json::array();
  const bool several = estimate.faces.size() > 1;
  for (std::size_t i = 0; i < estimate.faces.size(); ++i)
    faces.push_back(face_json(estimate.faces[i], several ? pipeline::face_folder(i) : ""));
  return {
      {"photo", {{"width_px", estimate.photo_width}, {"height_px", estimate.photo_height}}},
      {"focal_px", estimate.camera.focal_px},
      {"up_cam", vector_json(pipeline::up_in(estimate))},
      {"faces", faces},
      {"largest_face", estimate.largest},
      {"joint_folder", estimate.joint ? Json("joint") : Json()},
      {"spot", {{"at_px", {spot.at_px.x(), spot.at_px.y()}}, {"distance_m", spot.depth_m}, {"height_m", spot.height_m}}},
      {"room", room != nullptr ? Json::parse(pipeline::room_json(*room, record.name)) : Json()},
      {"report", Json::parse(pipeline::report_json(estimate, photo, options, record.name))},
      {"files", files_json(record.files)}};
}

Json estimate_json(const EstimateRecord& record) {
  const JobState state = record.job.state();
  Json json = {{"id", record.id}, {"name", record.name}, {"job", job_json(state)}};
  if (state.phase == JobPhase::kDone) json.update(record.described);
  return json;
}

Json summary_json(const EstimateRecord& record) {
  const JobState state = record.job.state();
  Json json = {{"id", record.id}, {"name", record.name}, {"job", job_json(state)}};
  if (state.phase == JobPhase::kDone) json["faces"] = record.estimate.faces.size();
  return json;
}

Json insertion_json(const InsertionRecord& record) {
  const JobState state = record.job.state();
  Json json = {{"id", record.id}, {"estimate", record.estimate->id}, {"job", job_json(state)}};
  if (state.phase == JobPhase::kDone) json["files"] = files_json(record.files);
  return json;
}

}  // namespace faceprobe::serve
