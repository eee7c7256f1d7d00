#include "rival_light_methods.h"

#include "faceprobe/assets/maps.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/net/face_window.h"
#include "faceprobe/train/map_crops.h"
#include "torch_side.h"

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

// Of each map of the data, by its number; empty where the folder lacks it.
std::vector<EnvMap> maps_of(const fs::path& folder, const std::string& recipe) {
  std::map<std::string, EnvMap> by_name;
  for (auto& [name, map] : assets::load_maps(folder.string())) by_name[name] = std::move(map);
  std::vector<EnvMap> maps;
  const nlohmann::json json = nlohmann::json::parse(recipe, nullptr, false);
  for (const auto& name : json.value("maps", nlohmann::json::array())) {
    const auto found = name.is_string() ? by_name.find(name.get<std::string>()) : by_name.end();
    maps.push_back(found == by_name.end() ? EnvMap() : found->second);
  }
  return maps;
}

// What is behind the head, as a photo of it would be.
class Backgrounds {
 public:
  Backgrounds(const fs::path& folder, const std::string& recipe) : maps_(maps_of(folder, recipe)) {}

  std::optional<Image> behind(const eval::LightInput& input) const {
    const auto number = static_cast<std::size_t>(input.sample.map);
    if (number >= maps_.size() || maps_[number].width() == 0) return std::nullopt;
    return train::crop_of_map(maps_[number], {.yaw_rad = input.sample.map_yaw});
  }

 private:
  std::vector<EnvMap> maps_;
};

eval::LightMethod of_background(const std::string& name, const PictureLight& light,
                                const std::shared_ptr<Backgrounds>& scenes) {
  return {name, [light, scenes](const eval::LightInput& input) -> Eigen::MatrixX3f {
            const std::optional<Image> crop = scenes->behind(input);
            return crop ? light(*crop) : Eigen::MatrixX3f();
          }};
}

eval::LightMethod of_face(const std::string& name, const SizedPictureLight& network) {
  return {name, [network](const eval::LightInput& input) -> Eigen::MatrixX3f {
            const std::optional<Window> window = net::face_window(input.photo.mask, network.picture_px);
            if (!window) return {};
            return network.light(resampled(input.photo.linear, *window, Outside::kEdge));
          }};
}

// Names of the rows, and of those that are missing.
constexpr const char* kGardner = "gardner, trained on few maps";      // 2017
constexpr const char* kHoldGeoffroy = "hold-geoffroy, preetham sky";  // 2017
constexpr const char* kLegendre = "legendre, from the face";          // 2020
constexpr const char* kLegendreFile = "legendre.safetensors";

// The weights of a row, or nothing and a sentence.
std::optional<fs::path> weights_of(const fs::path& folder, const char* row, const char* file, std::string& missing) {
  const fs::path path = folder / file;
  if (!folder.empty() && fs::exists(path)) return path;
  missing += std::string(missing.empty() ? "" : " ") + "No row of " + row + ": its weights, " + file +
             ", are not in a folder that --rivals names; docs/training.md says how they are made.";
  return std::nullopt;
}

// The window on the face, of the photo instead of the crop.
Window in_photo(const Window& window, const face::Crop& crop) {
  const Eigen::Vector2d corner = crop.photo_from_crop(window.left_px, window.top_px);
  return {corner.x(), corner.y(), window.scale * crop.scale, window.width, window.height};
}

}  // namespace

std::optional<FaceLightMethod> face_network_method(const fs::path& weights, std::string& missing) {
  const std::optional<fs::path> file = weights_of(weights, kLegendre, kLegendreFile, missing);
  if (!file) return std::nullopt;
  return FaceLightMethod{
      kLegendre, [network = torch_side().light_regressor(*file)](const FaceSeen& seen) -> Eigen::MatrixX3f {
        const face::FaceGeometry& geometry = seen.face.geometry;
        const std::optional<Window> window = net::face_window(geometry.region, network.picture_px);
        if (!window) return {};
        return network.light(resampled(seen.linear, in_photo(*window, geometry.crop), Outside::kEdge));
      }};
}

RivalMethods rival_light_methods(const RivalRows& rows) {
  RivalMethods found;
  const auto of = [&](const char* row, const char* file) { return weights_of(rows.weights, row, file, found.missing); };
  const std::optional<fs::path> gardner = of(kGardner, "gardner.safetensors");
  const std::optional<fs::path> sky = of(kHoldGeoffroy, "sky.safetensors");
  if (gardner || sky) {
    const auto scenes = std::make_shared<Backgrounds>(rows.maps, rows.recipe);
    if (gardner) found.methods.push_back(of_background(kGardner, torch_side().light_regressor(*gardner).light, scenes));
    if (sky)
      found.methods.push_back(of_background(kHoldGeoffroy, torch_side().sky_regressor(*sky, rows.threads), scenes));
  }
  if (const auto legendre = of(kLegendre, kLegendreFile))
    found.methods.push_back(of_face(kLegendre, torch_side().light_regressor(*legendre)));
  return found;
}

}  // namespace faceprobe::cli
