#include "faceprobe/synth/generate.h"

#include <nlohmann/json.hpp>
#include <sstream>

namespace faceprobe::synth {
namespace {

template <class T>
nlohmann::json names(const std::vector<T>& items) {
  nlohmann::json list = nlohmann::json::array();
  for (const T& item : items) list.push_back(item.name);
  return list;
}

template <class T>
std::string sentence_of(const std::vector<T>& items) {
  std::string text;
  for (const T& item : items) text += (text.empty() ? "" : ", ") + item.name;
  return text.empty() ? "none" : text;
}

}  // namespace

GenerateTimes& GenerateTimes::operator+=(const GenerateTimes& other) {
  scene += other.scene;
  transport += other.transport;
  shade += other.shade;
  compose += other.compose;
  write += other.write;
  return *this;
}

std::string recipe_of(const Assets& assets, const Recipe& recipe) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_json(recipe));
  json["heads"] = names(assets.heads);
  json["skins"] = names(assets.skins);
  json["maps"] = names(assets.maps);
  if (assets.reflectance) {
    nlohmann::json regions = nlohmann::json::array();
    for (const SkinStatistics::Value& r : assets.reflectance->regions) {
      regions.push_back({r.roughness, r.roughness_deviation, r.specular_albedo, r.specular_albedo_deviation});
    }
    json["reflectance"] = regions;
  }
  return json.dump();
}

std::string data_card(const Assets& assets, const Recipe& recipe) {
  std::ostringstream card;
  card << "# Synthetic faces\n\n"
       << recipe.count << " samples of " << recipe.person_count() << (recipe.multi_face ? " groups" : " people")
       << " at " << recipe.size_px << " px, " << recipe.views_per_person
       << (recipe.multi_face ? " views a group, " : " views a person, ") << recipe.samples_per_view
       << " lights a view.\n\n"
       << "Made by `faceprobe synth`; no photograph of a person is among the pictures, but skin textures may come from "
          "some.\n\n"
       << "| | |\n|---|---|\n"
       << "| recipe | `" << to_json(recipe) << "` |\n"
       << "| head models | " << sentence_of(assets.heads) << " |\n"
       << "| skin textures | " << assets.skins.size() << ": " << sentence_of(assets.skins) << " |\n"
       << "| environment maps | " << assets.maps.size() << ": " << sentence_of(assets.maps) << " |\n"
       << "| reflectance | " << (assets.reflectance ? "measured statistics" : "estimate") << " |\n\n"
       << "Layers are linear Rec.709 with 1 = the photo's white: diffuse + highlight is the scene before the camera, "
          "and diffuse = "
          "albedo x shading on the person. Normals are in the camera frame (+x right, +y up, +z towards the camera). "
          "Depth in metres.\n"
          "The environment is the lat-long map as the camera's frame sees it: centre column +z, u = .25 is +x.\n\n"
       << "The terms of the assets above apply to what was made of them: name their authors.\n";
  return card.str();
}

}  // namespace faceprobe::synth
