#include "faceprobe/pipeline/room.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Longest half axis of the ellipsoid of one standard deviation.
double largest_deviation(const Eigen::Matrix3d& covariance) {
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues().maxCoeff());
}

Json lamp_json(const lighting::Lamp& lamp) {
  Json json = {{"near", lamp.near}, {"direction", array_of(lamp.direction)}, {"colour_rgb", array_of(lamp.colour)}};
  if (lamp.near) {
    json["position_m"] = array_of(lamp.position_m);
    Json rows = Json::array();
    for (int r = 0; r < 3; ++r) rows.push_back(array_of(lamp.covariance_m2.row(r).transpose()));
    json["position_covariance_m2"] = rows;
    json["position_deviation_m"] = largest_deviation(lamp.covariance_m2);
    json["intensity"] = lamp.intensity;
  } else {
    json["irradiance"] = lamp.intensity;
  }
  json["miss_deg"] = lamp.miss_deg;
  json["seen_by"] = Json::array();
  for (const lighting::Sighting& s : lamp.seen)
    json["seen_by"].push_back({{"face", s.face + 1}, {"light", s.light + 1}});
  return json;
}

}  // namespace

std::string RoomOptions::validate() const {
  if (std::string fault = triangulate.validate(); !fault.empty()) return fault;
  if (!(least_position_error_m > 0 && least_position_error_m < 100))
    return "least_position_error_m must lie in (0, 100).";
  if (!(relative_position_error >= 0 && relative_position_error < 1))
    return "relative_position_error must lie in [0, 1).";
  return {};
}

Room find_lamps(const Estimate& estimate, const RoomOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  if (estimate.faces.size() < 2) {
    throw Error(ExitCode::kNoFace,
                "The photo shows " + std::to_string(estimate.faces.size()) +
                    " usable face; a lamp's place needs two at least. `faceprobe estimate` gives the light of one.");
  }
  Room room;
  for (const FaceEstimate& face : estimate.faces) {
    const Eigen::Vector3d position = face.face.position_m();
    const double error = std::max(options.least_position_error_m, options.relative_position_error * position.norm());
    room.faces.push_back({position, error, face.lights});
  }
  room.lamps = lighting::triangulate(room.faces, options.triangulate);
  return room;
}

std::string room_json(const Room& room, const std::string& source) {
  Json json;
  json["schema"] = "faceprobe-room/1";
  json["program"] = {{"name", "faceprobe"}, {"version", kVersion}};
  json["photo"] = source;
  json["frame"] = "camera: +x right in the photo, +y up, +z towards the viewer; metres; directions towards the light";
  json["numbers"] = "faces count from 1, left to right; a face's lights from 1, strongest first";
  json["faces"] = Json::array();
  for (const lighting::FaceLights& face : room.faces) {
    Json lights = Json::array();
    for (const lighting::MainLight& light : face.lights)
      lights.push_back({{"direction", array_of(light.direction)},
                        {"colour_rgb", array_of(light.colour)},
                        {"irradiance", light.irradiance},
                        {"solid_angle_sr", light.solid_angle_sr},
                        {"share_of_energy", light.share}});
    json["faces"].push_back({{"position_m", array_of(face.position_m)},
                             {"position_deviation_m", face.position_error_m},
                             {"main_lights", lights}});
  }
  json["lamps"] = Json::array();
  for (const lighting::Lamp& lamp : room.lamps) json["lamps"].push_back(lamp_json(lamp));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string room_gltf(const Room& room, const face::Camera& camera, int photo_width, int photo_height) {
  Json gltf;
  gltf["asset"] = {{"version", "2.0"}, {"generator", "faceprobe " + std::string(kVersion)}};
  gltf["cameras"] = Json::array();
  gltf["cameras"].push_back({{"type", "perspective"},
                             {"name", "Photo"},
                             {"perspective",
                              {{"yfov", 2 * std::atan(0.5 * photo_height / camera.focal_px)},
                               {"aspectRatio", static_cast<double>(photo_width) / photo_height},
                               {"znear", 0.01}}}});
  Json nodes = Json::array();
  nodes.push_back({{"name", "Camera"}, {"camera", 0}});
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    nodes.push_back({{"name", "Face " + std::to_string(i + 1)},
                     {"translation", array_of(room.faces[i].position_m)},
                     {"extras", {{"position_deviation_m", room.faces[i].position_error_m}}}});
  }
  Json lights = Json::array();
  for (const lighting::Lamp& lamp : room.lamps) {
    const auto number = lights.size();
    Json light = {{"name", "Lamp " + std::to_string(number + 1)},
                  {"type", lamp.near ? "point" : "directional"},
                  {"color", array_of((lamp.colour / lamp.colour.maxCoeff()).cwiseMax(0.0))},
                  {"intensity", lamp.intensity * lamp.colour.maxCoeff()}};
    Json node = {{"name", light["name"]}, {"extensions", {{"KHR_lights_punctual", {{"light", number}}}}}};
    if (lamp.near) {
      node["translation"] = array_of(lamp.position_m);
      node["extras"] = {{"position_deviation_m", largest_deviation(lamp.covariance_m2)}};
    } else {
      // Directional lights shine along their node's -z.
      const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), lamp.direction);
      node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
    }
    lights.push_back(light);
    nodes.push_back(node);
  }
  if (!lights.empty()) {
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  }
  Json all = Json::array();
  for (std::size_t i = 0; i < nodes.size(); ++i) all.push_back(i);
  gltf["nodes"] = nodes;
  gltf["scenes"] = Json::array({{{"name", "Room"}, {"nodes", all}}});
  gltf["scene"] = 0;
  return gltf.dump(1) + "\n";
}

}  // namespace faceprobe::pipeline
