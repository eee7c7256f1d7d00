#include "faceprobe/pipeline/report.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/version.h"

#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {

namespace {

using Json = nlohmann::ordered_json;

template <class Vector>
Json array_of(const Vector& v) {
  Json out = Json::array();
  for (const auto value : v) out.push_back(value);
  return out;
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json sh_json(const Eigen::MatrixX3d& sh) {
  Json coefficients = Json::array();
  for (Eigen::Index i = 0; i < sh.rows(); ++i) coefficients.push_back(array_of(Eigen::Vector3d(sh.row(i).transpose())));
  return {{"basis", "real, orthonormal, no Condon-Shortley sign; polar axis +z of the camera frame"},
          {"quantity", "radiance"},
          {"order", "(0,0), (1,-1), (1,0), (1,1), (2,-2) .. (2,2), ..."},
          {"rgb", coefficients}};
}

Json lights_json(const std::vector<lighting::MainLight>& lights) {
  Json out = Json::array();
  for (const lighting::MainLight& light : lights) {
    out.push_back({{"direction", array_of(light.direction)},
                   {"azimuth_deg", azimuth_deg(light.direction)},
                   {"elevation_deg", elevation_deg(light.direction)},
                   {"colour_rgb", array_of(light.colour)},
                   {"irradiance", light.irradiance},
                   {"peak_radiance", light.peak_radiance},
                   {"solid_angle_sr", light.solid_angle_sr},
                   {"share_of_energy", light.share},
                   {"direction_uncertainty_deg", number_or_null(light.direction_uncertainty_deg)},
                   {"irradiance_uncertainty", number_or_null(light.irradiance_uncertainty)}});
  }
  return out;
}

Json light_json(const LightResult& result) {
  const std::optional<lighting::CompactLight>& compact = result.light.compact;
  return {{"ambient_rgb", array_of(result.light.ambient)},
          {"mean_confidence", result.light.confidence.size() > 0 ? result.light.confidence.mean() : 0.0F},
          {"highlight_gain", result.light.highlight_gain},
          {"highlight_leak", result.light.leak},
          {"highlight_residual", number_or_null(result.light.highlight_residual)},
          {"shading_residual", number_or_null(result.light.shading_residual)},
          {"compact_light_width_deg", compact ? Json(compact->width_deg) : Json()},
          {"compact_light_evidence", compact ? Json(compact->evidence) : Json()},
          {"main_lights", lights_json(result.lights)},
          {"light_to_ambient_ratio", lighting::light_to_ambient_ratio(result.lights)},
          {"spherical_harmonics", sh_json(result.sh)},
          {"spherical_harmonics_4", sh_json(result.sh4)}};
}

std::string_view focal_source_name(FocalSource source) {
  switch (source) {
    case FocalSource::kGiven: return "given";
    case FocalSource::kExif: return "exif";
    default: return "default (50 mm on a 36 x 24 mm frame)";
  }
}

const char* normals_name(NormalSource source) {
  switch (source) {
    case NormalSource::kNet: return "net";
    case NormalSource::kFit: return "3dmm";
    default: return "mesh";
  }
}
const char* shading_name(ShadingSource source) {
  switch (source) {
    case ShadingSource::kNet: return "net";
    case ShadingSource::kGiven: return "given";
    default: return "regions";
  }
}
const char* prior_name(PriorSource source) { return source == PriorSource::kNet ? "net" : "smooth"; }

Json sources_json(const FaceSources& sources) {
  return {{"separator", sources.classical ? highlight::separator_name(*sources.classical) : "net"},
          {"geometry", normals_name(sources.normals)},
          {"shading", shading_name(sources.shading)},
          {"prior", prior_name(sources.prior)}};
}

Json same_person_json(const std::optional<SamePerson>& same) {
  if (!same) return {};
  return {{"photos", same->photos},
          {"shading_gain_rgb", array_of(same->shading_gain)},
          {"albedo_rgb", array_of(same->albedo)},
          {"trust", same->trust}};
}

Json face_json(const FaceEstimate& face) {
  // Photo coordinates keep y down, as pixels do; the pose is in the camera frame, y up.
  const Eigen::Matrix3d rotation = face.face.camera_from_face.rotation();
  const Eigen::Vector3d forward = rotation.col(2);
  Json rows = Json::array();
  const std::optional<Eigen::Vector3f> albedo = mean_skin_albedo(face);
  for (int r = 0; r < 3; ++r) rows.push_back(array_of(Eigen::Vector3d(rotation.row(r).transpose())));
  return {
      {"box_px",
       {{"x", face.face.box.x}, {"y", face.face.box.y}, {"width", face.face.box.width}, {"height", face.face.box.height}}},
      {"score", face.face.score},
      {"rough_landmarks", face.face.rough_landmarks},
      {"position_m", array_of(face.face.position_m())},
      {"camera_from_face_rotation", rows},
      {"yaw_deg", azimuth_deg(forward)},
      {"pitch_deg", elevation_deg(forward)},
      {"reprojection_rms_px", face.face.reprojection_rms_px},
      {"sources", sources_json(face.sources)},
      {"patches", face.observations.count()},
      {"light_colour_rgb", array_of(face.light_colour)},
      {"light_colour_uncertainty_deg", number_or_null(face.light_colour_uncertainty_deg)},
      {"skin_albedo_mean_rgb", albedo ? array_of(*albedo) : Json()},
      {"same_person", same_person_json(face.same_person)},
      {"light", light_json(face)}};
}

Json program_json() { return {{"name", "faceprobe"}, {"version", kVersion}}; }

constexpr std::string_view kFrame =
    "camera: +x right in the photo, +y up, +z towards the viewer; directions from the face to the light";

Json options_json(const EstimateOptions& options) {
  return {{"separator", options.separator_name()},
          {"geometry", normals_name(options.classical && options.normals == NormalSource::kNet ? NormalSource::kMesh
                                                                                               : options.normals)},
          {"shading", shading_name(options.classical && options.shading == ShadingSource::kNet ? ShadingSource::kRegions
                                                                                               : options.shading)},
          {"solver", lighting::solver_name(options.solve.solver)},
          {"prior", prior_name(options.asks_prior() ? PriorSource::kNet : PriorSource::kSmooth)},
          {"compact_light", options.solve.compact_light && options.solve.solver == lighting::Solver::kTransport},
          {"iterations", options.solve.iterations},
          {"iterations_from_expected", options.solve.iterations_from_expected},
          {"nside", options.solve.nside},
          {"map_size_px", {options.map_width, options.map_width / 2}},
          {"layer_px", options.layer_px},
          {"deterministic", options.deterministic}};
}

// Names of files may be any bytes; what is not UTF-8 is replaced rather than thrown at the user.
std::string text_of(const Json& report) { return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string report_json(const Estimate& estimate, const io::Photo& photo, const EstimateOptions& options,
                        const std::string& source) {
  Json report;
  report["schema"] = kReportSchema;
  report["program"] = program_json();
  report["frame"] = kFrame;
  report["photo"] = {{"source", source},
                     {"sha256", photo.sha256},
                     {"format", photo.format},
                     {"colour_space", photo.colour_space},
                     {"bits_per_channel", photo.bits_per_channel},
                     {"grey", photo.grey},
                     {"exif_orientation_applied", photo.exif_orientation},
                     {"width_px", estimate.photo_width},
                     {"height_px", estimate.photo_height}};
  report["camera"] = {{"focal_px", estimate.camera.focal_px},
                      {"focal_source", focal_source_name(estimate.focal_source)},
                      {"centre_px", {estimate.camera.centre_x_px, estimate.camera.centre_y_px}}};
  report["options"] = options_json(options);
  report["largest_face"] = estimate.largest;
  report["faces"] = Json::array();
  for (const FaceEstimate& face : estimate.faces) report["faces"].push_back(face_json(face));
  if (estimate.joint) report["joint_light"] = light_json(*estimate.joint);
  Json timings = Json::array();
  double total = 0;
  for (const StageTime& stage : estimate.timings) {
    timings.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}});
    total += stage.seconds;
  }
  report["timings"] = {{"stages", timings}, {"total_seconds", total}};
  report["warnings"] = estimate.warnings;
  return text_of(report);
}

std::string joint_report_json(const LightResult& light, const std::vector<JointPhoto>& photos,
                              const EstimateOptions& options) {
  Json report;
  report["schema"] = kJointReportSchema;
  report["program"] = program_json();
  report["frame"] = kFrame;
  report["photos"] = Json::array();
  for (const JointPhoto& photo : photos)
    report["photos"].push_back({{"source", photo.source}, {"sha256", photo.sha256}, {"faces", photo.faces}});
  report["options"] = options_json(options);
  report["light"] = light_json(light);
  return text_of(report);
}

}  // namespace faceprobe::pipeline
