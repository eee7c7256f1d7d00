// glTF 2.0 with EXT_lights_image_based and KHR_lights_punctual. See docs/recipes.md for what its readers make of it.
#include "faceprobe/core/sh.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/scene_files.h"
#include "pipeline/cube_light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace faceprobe::pipeline {
namespace {

using Gltf = nlohmann::ordered_json;

constexpr char kImageBased[] = "EXT_lights_image_based";
constexpr char kPunctual[] = "KHR_lights_punctual";
constexpr int kCubeSize = 64;
// 64, 32, 16 and 8 texels wide, for roughness 0, 1/3, 2/3 and 1.
constexpr int kCubeLevels = 4;

float brightest_of(const EnvMap& map) {
  const auto& values = map.radiance().values();
  return *std::max_element(values.begin(), values.end());
}

Gltf triple_of(const Eigen::Vector3d& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; }

// Appends the faces to `images`, and returns their numbers.
Gltf add_faces(const CubeFaces& faces, float gain, Gltf& images) {
  Gltf numbers = Gltf::array();
  for (Image face : faces) {
    for (float& value : face.values()) value *= gain;
    numbers.push_back(images.size());
    Gltf image;
    image["uri"] = io::png_data_uri(encode_rgbd(face));
    images.push_back(std::move(image));
  }
  return numbers;
}

Gltf image_light(const EnvMap& rest, Gltf& images) {
  // What RGBD cannot hold goes into the intensity, which multiplies everything.
  const double intensity = std::max(1.0, static_cast<double>(brightest_of(rest) / kLargestRgbd));
  const auto gain = static_cast<float>(1 / intensity);
  Gltf levels = Gltf::array();
  const SphereGrid grid(16);
  const Eigen::MatrixX3f cells = grid_from_env_map(rest, grid);
  for (int level = 0; level < kCubeLevels; ++level) {
    const int size = kCubeSize >> level;
    const double roughness = static_cast<double>(level) / (kCubeLevels - 1);
    levels.push_back(
        add_faces(level == 0 ? sharp_cube(rest, size) : rough_cube(cells, grid, roughness, size), gain, images));
  }
  Gltf coefficients = Gltf::array();
  const Eigen::MatrixX3d irradiance = gltf_irradiance_coefficients(sh::project(rest, 2)) / intensity;
  for (Eigen::Index i = 0; i < irradiance.rows(); ++i) coefficients.push_back(triple_of(irradiance.row(i).transpose()));
  Gltf out;
  out["name"] = "Environment";
  out["intensity"] = intensity;
  out["rotation"] = std::array<int, 4>{0, 0, 0, 1};
  out["irradianceCoefficients"] = std::move(coefficients);
  out["specularImageSize"] = kCubeSize;
  out["specularImages"] = std::move(levels);
  return out;
}

Gltf lamp_node(const lighting::MainLight& light) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), light.direction);
  Gltf out;
  out["name"] = "MainLight";
  out["rotation"] = std::array<double, 4>{turn.x(), turn.y(), turn.z(), turn.w()};
  out["extensions"][kPunctual]["light"] = 0;
  return out;
}

// Colours of glTF do not exceed 1.
Gltf lamp(const lighting::MainLight& light) {
  const Eigen::Vector3d colour = light.colour.cwiseMax(0.0);
  const double largest = colour.maxCoeff();
  Gltf out;
  out["name"] = "MainLight";
  out["type"] = "directional";
  out["color"] = triple_of(colour / largest);
  out["intensity"] = light.irradiance * largest;
  return out;
}

}  // namespace

Eigen::MatrixX3d gltf_irradiance_coefficients(const Eigen::MatrixX3d& radiance) {
  if (radiance.rows() < 9) throw std::invalid_argument("Irradiance needs the nine coefficients of order 2.");
  // Condon and Shortley: minus for odd m. x turned round: minus where the function is odd in x, which are cosines of odd m and sines of even m.
  constexpr std::array<int, 9> kSign = {1, -1, 1, 1, -1, -1, 1, 1, 1};
  Eigen::MatrixX3d out(9, 3);
  for (int i = 0; i < 9; ++i) {
    const int band = i == 0 ? 0 : (i < 4 ? 1 : 2);
    out.row(i) = kSign[static_cast<std::size_t>(i)] * sh::cosine_lobe(band) * radiance.row(i);
  }
  return out;
}

std::string gltf_scene(const LightResult& light, const EnvMap& rest) {
  Gltf images = Gltf::array();
  Gltf gltf;
  gltf["asset"]["version"] = "2.0";
  gltf["asset"]["generator"] = "faceprobe " + std::string(kVersion);
  gltf["extensionsUsed"].push_back(kImageBased);
  gltf["extensions"][kImageBased]["lights"].push_back(image_light(rest, images));
  Gltf scene;
  scene["extensions"][kImageBased]["light"] = 0;
  if (!light.lights.empty()) {
    gltf["extensionsUsed"].push_back(kPunctual);
    gltf["extensions"][kPunctual]["lights"].push_back(lamp(light.lights.front()));
    gltf["nodes"].push_back(lamp_node(light.lights.front()));
    scene["nodes"].push_back(0);
  }
  gltf["scene"] = 0;
  gltf["scenes"].push_back(std::move(scene));
  gltf["images"] = std::move(images);
  Gltf& extras = gltf["extras"];
  extras["frame"] = "camera of the portrait: +x right in the photo, +y up, +z towards the viewer";
  extras["scale"] = "relative: a radiance of 1 is about the photo's white";
  extras["images"] = "the map without the main light; RGBD: (rgb / 255)^2.2 / (a / 255)";
  extras["cube"] = "left-handed, as cube maps are: its x is minus the scene's; faces upside down";
  extras["irradiance"] =
      "orthonormal real harmonics with the Condon-Shortley sign, in the cube's axes, not divided by pi";
  return gltf.dump(1) + "\n";
}

}  // namespace faceprobe::pipeline
