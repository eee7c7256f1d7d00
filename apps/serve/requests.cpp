#include "serve/requests.h"

#include "faceprobe/core/error.h"
#include "faceprobe/render/material.h"
#include "faceprobe/render/shapes.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr std::size_t kLongestName = 120;  // bytes

Json object_in(const std::string& body) {
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) throw Refusal(FailureKind::kUsage, "The request must be a JSON object in UTF-8.");
  return json;
}

// The value of a key, which is then gone from `json`: what is left over is unknown.
std::optional<Json> take(Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) return std::nullopt;
  Json value = std::move(*found);  // a copy would go as deep as the client nested it
  json.erase(found);
  return value;
}

void refuse_leftovers(const Json& json) {
  if (!json.empty())
    throw Refusal(FailureKind::kUsage, "'" + json.begin().key() + "' is not something that can be asked for.");
}

std::string take_text(Json& json, const char* key, const std::string& otherwise) {
  const std::optional<Json> value = take(json, key);
  if (!value) return otherwise;
  if (!value->is_string()) throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be a text.");
  return value->get<std::string>();
}

std::optional<double> take_number(Json& json, const char* key) {
  const std::optional<Json> value = take(json, key);
  if (!value) return std::nullopt;
  if (!value->is_number()) throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be a number.");
  return value->get<double>();
}

std::optional<int> take_index(Json& json, const char* key) {
  const std::optional<Json> value = take(json, key);
  if (!value) return std::nullopt;
  if (!value->is_number_integer() || *value < 0 || *value > 1000)
    throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be a whole number from 0 on.");
  return value->get<int>();
}

bool take_switch(Json& json, const char* key, bool otherwise) {
  const std::optional<Json> value = take(json, key);
  if (!value) return otherwise;
  if (!value->is_boolean()) throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be true or false.");
  return value->get<bool>();
}

std::optional<Eigen::Vector2d> take_point(Json& json, const char* key) {
  const std::optional<Json> value = take(json, key);
  if (!value) return std::nullopt;
  if (!value->is_array() || value->size() != 2 || !(*value)[0].is_number() || !(*value)[1].is_number())
    throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be two numbers, x and y.");
  return Eigen::Vector2d((*value)[0].get<double>(), (*value)[1].get<double>());
}

std::optional<Eigen::Vector3f> take_colour(Json& json, const char* key) {
  const std::optional<Json> value = take(json, key);
  if (!value) return std::nullopt;
  if (!value->is_array() || value->size() != 3 ||
      !std::ranges::all_of(*value, [](const Json& v) { return v.is_number(); }))
    throw Refusal(FailureKind::kUsage, "'" + std::string(key) + "' must be three numbers, red, green and blue.");
  return Eigen::Vector3f((*value)[0].get<float>(), (*value)[1].get<float>(), (*value)[2].get<float>());
}

// Names only: a client's file names are none of this machine's.
void check_name(const std::string& name, const std::vector<std::string>& known, const char* what) {
  if (std::ranges::find(known, name) != known.end()) return;
  throw Refusal(FailureKind::kUsage,
                "There is no " + std::string(what) + " '" + name + "'; there are " + listed(known) + ".");
}

std::optional<float> as_float(std::optional<double> value) {
  if (!value) return std::nullopt;
  return static_cast<float>(*value);
}

render::MaterialChange take_surface(Json& json) {
  render::MaterialChange surface;
  if (const std::string kind = take_text(json, "kind", ""); !kind.empty()) {
    check_name(kind, render::material_kind_names(), "kind of material");
    surface.kind = render::material_kind_from_name(kind);
  }
  surface.colour = take_colour(json, "colour_rgb");
  surface.roughness = as_float(take_number(json, "roughness"));
  surface.ior = as_float(take_number(json, "index"));
  return surface;
}

}  // namespace

std::string read_sample_request(const std::string& body) {
  Json json = object_in(body);
  std::string sample = take_text(json, "sample", "");
  refuse_leftovers(json);
  if (sample.empty()) throw Refusal(FailureKind::kUsage, "'sample' must name a sample photo.");
  return sample;
}

InsertionRequest read_insertion_request(const std::string& body) {
  Json json = object_in(body);
  InsertionRequest request;
  request.object = take_text(json, "object", "");
  check_name(request.object, render::shape_names(), "object");
  request.material = take_text(json, "material", "");
  if (!request.material.empty()) check_name(request.material, render::material_preset_names(), "material");
  request.surface = take_surface(json);
  request.where.at_px = take_point(json, "at_px");
  request.where.beside_m = as_float(take_number(json, "beside_m"));
  request.where.depth_m = as_float(take_number(json, "distance_m"));
  request.where.height_m = as_float(take_number(json, "height_m"));
  request.where.turn_deg = as_float(take_number(json, "turn_deg")).value_or(0);
  request.where.ground = take_switch(json, "ground", true);
  request.where.face = take_index(json, "face");
  request.where.joint_light = take_switch(json, "joint_light", false);
  const std::string quality = take_text(json, "quality", "final");
  if (quality != "preview" && quality != "final")
    throw Refusal(FailureKind::kUsage, "'quality' is preview or final, found '" + quality + "'.");
  request.preview = quality == "preview";
  refuse_leftovers(json);
  return request;
}

std::string shown_name(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  }
  if (name.size() > kLongestName) {
    std::size_t cut = kLongestName;
    while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xC0U) == 0x80U) --cut;  // not within a UTF-8 character
    name.resize(cut);
  }
  return name.empty() ? "photo" : name;
}

}  // namespace faceprobe::serve
