#include "faceprobe/pipeline/scene_files.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/picture_file.h"
#include "pipeline/cube_light.h"
#include "pipeline/light_result.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

namespace faceprobe::pipeline {
namespace {

// A red lamp high at camera right, on an even surround.
LightResult lamp_light(const EstimateOptions& options, const Eigen::Vector3f& towards) {
  const SphereGrid grid(options.solve.nside);
  lighting::Light light;
  light.radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).dot(towards.normalized()) > 0.99F) light.radiance.row(j) += Eigen::RowVector3f(40, 10, 10);
  }
  light.confidence = Eigen::VectorXf::Ones(grid.cell_count());
  light.ambient.setConstant(0.1F);
  return light_result(std::move(light), options);
}

// The numbers that follow a name, up to the end of its line.
std::vector<double> numbers_after(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name);
  EXPECT_NE(at, std::string::npos) << name;
  const std::string line = text.substr(at + name.size(), text.find('\n', at) - at - name.size());
  std::vector<double> numbers;
  const std::regex number(R"([-+]?\d+\.?\d*(e[-+]?\d+)?)");
  for (std::sregex_iterator it(line.begin(), line.end(), number), end; it != end; ++it)
    numbers.push_back(std::stod(it->str()));
  return numbers;
}

TEST(SceneFiles, TheUsdLampShinesFromWhereItIsAndAsStrong) {
  const EstimateOptions options;
  const LightResult light = lamp_light(options, {1, 0.5F, 0.3F});
  ASSERT_EQ(light.lights.size(), 1U);
  const lighting::MainLight& main = light.lights[0];
  const std::string usd = usd_scene(light, "environment_rest.exr");
  EXPECT_EQ(usd.rfind("#usda 1.0", 0), 0U);
  EXPECT_NE(usd.find("@environment_rest.exr@"), std::string::npos);
  const std::vector<double> matrix = numbers_after(usd, "xformOp:transform =");
  ASSERT_EQ(matrix.size(), 16U);
  // The third row is where the lamp's own z goes, from which it shines; rows are at right angles.
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> rows(matrix.data());
  EXPECT_LT((rows.row(2).head<3>().transpose() - main.direction).norm(), 1e-6);
  EXPECT_NEAR((rows.topLeftCorner<3, 3>().transpose() * rows.topLeftCorner<3, 3>() - Eigen::Matrix3d::Identity()).norm(),
              0, 1e-6);
  EXPECT_NEAR((rows.topLeftCorner<3, 3>().determinant()), 1, 1e-6);
  const double angle_deg = numbers_after(usd, "inputs:angle =").at(0);
  const std::string lamp = usd.substr(usd.find("DistantLight"));
  const double radiance = numbers_after(lamp, "inputs:intensity =").at(0);
  EXPECT_NEAR(radiance * 2 * kPi * (1 - std::cos(radians(angle_deg / 2))), main.irradiance, 1e-6 * main.irradiance);
}

TEST(SceneFiles, TheBlenderLampIsInBlendersAxes) {
  const EstimateOptions options;
  const LightResult light = lamp_light(options, {1, 0.5F, 0.3F});
  const std::string script = blender_script(light, "environment_rest.exr");
  const std::vector<double> towards = numbers_after(script, "\"towards\":");
  ASSERT_EQ(towards.size(), 3U);
  const Eigen::Vector3d& d = light.lights[0].direction;
  EXPECT_NEAR(towards[0], d.x(), 1e-6);   // right stays right
  EXPECT_NEAR(towards[1], -d.z(), 1e-6);  // towards the viewer is -y
  EXPECT_NEAR(towards[2], d.y(), 1e-6);   // up is +z
  EXPECT_NEAR(numbers_after(script, "\"irradiance\":").at(0), light.lights[0].irradiance, 1e-6);
}

TEST(SceneFiles, EvenLightHasNoLamp) {
  const EstimateOptions options;
  lighting::Light even;
  const SphereGrid grid(options.solve.nside);
  even.radiance = Eigen::MatrixX3f::Ones(grid.cell_count(), 3);
  even.confidence = Eigen::VectorXf::Ones(grid.cell_count());
  even.ambient.setOnes();
  const LightResult light = light_result(std::move(even), options);
  EXPECT_EQ(usd_scene(light, "x.exr").find("DistantLight"), std::string::npos);
  EXPECT_NE(blender_script(light, "x.exr").find("LAMP = None"), std::string::npos);
}

TEST(SceneFiles, MapAndLampTogetherAreTheWholeLight) {
  const EstimateOptions options;
  const LightResult light = lamp_light(options, {-0.5F, 0.2F, 1});
  const Eigen::Vector3d rest = rest_of_environment(light, options).integral();
  const Eigen::Vector3d lamp = light.lights[0].irradiance * light.lights[0].colour;
  EXPECT_LT((rest + lamp - light.environment.integral()).norm(), 1e-3 * light.environment.integral().norm());
}

using nlohmann::json;

// OpenGL's table of cube map faces: the texel that a look-up in the direction finds, t from the first row of memory.
struct CubeLookUp {
  int face;
  double s, t;
};
CubeLookUp cube_look_up(const Eigen::Vector3d& r) {
  const Eigen::Vector3d a = r.cwiseAbs();
  if (a.x() >= a.y() && a.x() >= a.z()) {
    return {r.x() > 0 ? 0 : 1, ((r.x() > 0 ? -r.z() : r.z()) / a.x() + 1) / 2, (-r.y() / a.x() + 1) / 2};
  }
  if (a.y() >= a.z())
    return {r.y() > 0 ? 2 : 3, (r.x() / a.y() + 1) / 2, ((r.y() > 0 ? r.z() : -r.z()) / a.y() + 1) / 2};
  return {r.z() > 0 ? 4 : 5, ((r.z() > 0 ? r.x() : -r.x()) / a.z() + 1) / 2, (-r.y() / a.z() + 1) / 2};
}

// As Babylon.js finds light from a direction of the scene: it turns the scene's x round and stores images from the last row on.
Eigen::Vector3f seen_in(const CubeFaces& faces, const Eigen::Vector3d& direction) {
  const CubeLookUp at = cube_look_up({-direction.x(), direction.y(), direction.z()});
  const Image& face = faces[static_cast<std::size_t>(at.face)];
  const int size = face.width();
  const auto index = [size](double share) { return std::min(size - 1, static_cast<int>(share * size)); };
  const float* p = face.pixel(index(at.s), size - 1 - index(at.t));
  return {p[0], p[1], p[2]};
}

// A lobe in each channel, around three directions that no rotation or mirroring of the axes swaps.
EnvMap three_lobes() {
  EnvMap map(256, 128);
  const Eigen::Vector3f centres[] = {{1, 0.1F, 0.3F}, {0.2F, 1, 0.5F}, {-0.4F, -0.2F, 1}};
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      for (int c = 0; c < 3; ++c)
        map.radiance()(x, y, c) = 0.1F + 5 * std::exp(4 * (map.direction(x, y).dot(centres[c].normalized()) - 1));
    }
  }
  return map;
}

TEST(CubeLight, ALookUpFindsTheMap) {
  const EnvMap map = three_lobes();
  const CubeFaces faces = sharp_cube(map, 64);
  const SphereGrid grid(8);
  for (int j = 0; j < grid.cell_count(); ++j) {
    const Eigen::Vector3f found = seen_in(faces, grid.direction(j).cast<double>());
    // Half a texel is up to 1.3 degrees; the lobes rise by 5 sqrt(4 / e) a radian at most.
    EXPECT_LT((found - map.sample(grid.direction(j))).cwiseAbs().maxCoeff(), 0.15F) << grid.direction(j).transpose();
  }
}

// Cube maps are left-handed: what is at camera right stands in the face of -x.
TEST(CubeLight, ARedLampAtCameraRightLightsTheFaceOfMinusX) {
  EnvMap map(64, 32);
  for (int y = 12; y < 20; ++y) {
    for (int x = 12; x < 20; ++x) map.radiance()(x, y, 0) = 9;
  }
  const CubeFaces faces = sharp_cube(map, 16);
  for (std::size_t face = 0; face < 6; ++face) {
    float red = 0;
    for (const float value : faces[face].values()) red += value;
    EXPECT_EQ(red > 0, face == 1) << face;
  }
}

TEST(CubeLight, EvenLightStaysEvenAtAnyRoughness) {
  const SphereGrid grid(16);
  const Eigen::MatrixX3f even = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.7F);
  for (const double roughness : {0.25, 0.6, 1.0}) {
    for (const Image& face : rough_cube(even, grid, roughness, 4)) {
      for (const float value : face.values()) EXPECT_NEAR(value, 0.7F, 1e-5F);  // float sums
    }
  }
}

// Against the integral of D(H) (N.L) on a fine grid of angles: light that depends on the angle to +z alone, looked at along +z and aside.
TEST(CubeLight, RoughnessBlursAsGgxSays) {
  const SphereGrid grid(16);
  Eigen::MatrixX3f cells(grid.cell_count(), 3);
  const auto radiance = [](const Eigen::Vector3d& d) { return 0.2 + 3 * std::exp(5 * (d.z() - 1)); };
  for (int j = 0; j < grid.cell_count(); ++j)
    cells.row(j).setConstant(static_cast<float>(radiance(grid.direction(j).cast<double>())));
  for (const double roughness : {1.0 / 3, 2.0 / 3, 1.0}) {
    const CubeFaces faces = rough_cube(cells, grid, roughness, 8);
    const double alpha = roughness * roughness;
    for (const auto& [face, column, row] : {std::array{4, 4, 4}, std::array{1, 2, 5}}) {
      const Eigen::Vector3d n = cube_direction(face, column, row, 8).normalized();
      const Eigen::Matrix3d frame = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), n).toRotationMatrix();
      double sum = 0;
      double total = 0;
      for (int i = 0; i < 400; ++i) {
        const double theta = (i + 0.5) / 400 * kPi / 2;
        const double cosine = std::cos(theta / 2);  // between N and H
        const double d = alpha * alpha / std::pow(cosine * cosine * (alpha * alpha - 1) + 1, 2);
        for (int k = 0; k < 64; ++k) {
          const double phi = 2 * kPi * k / 64;
          const Eigen::Vector3d l = frame * Eigen::Vector3d(std::sin(theta) * std::cos(phi),
                                                            std::sin(theta) * std::sin(phi), std::cos(theta));
          const double weight = d * std::cos(theta) * std::sin(theta);
          sum += weight * radiance(l);
          total += weight;
        }
      }
      // Cells are 3.7 degrees apart, the narrowest lobe some 13 wide.
      EXPECT_NEAR(faces[static_cast<std::size_t>(face)](column, row, 0), sum / total, 0.02 * sum / total) << roughness;
    }
  }
}

TEST(CubeLight, ATurnedLightGivesTurnedFaces) {
  const EnvMap map = three_lobes();
  // A quarter about the vertical: what was at camera right is then behind the face.
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(kPi / 2), Eigen::Vector3f::UnitY()).toRotationMatrix();
  const SphereGrid grid(16);
  const CubeFaces before = rough_cube(grid_from_env_map(map, grid), grid, 0.5, 16);
  const CubeFaces after = rough_cube(grid_from_env_map(rotate(map, turn), grid), grid, 0.5, 16);
  // A quarter takes centres of texels to centres of texels, columns of the map to columns, and cells of the grid to cells.
  for (int face = 0; face < 6; ++face) {
    for (int texel = 0; texel < 16 * 16; ++texel) {
      const Eigen::Vector3d d = cube_direction(face, texel % 16, texel / 16, 16);
      const Eigen::Vector3f error = seen_in(after, turn.cast<double>() * d) - seen_in(before, d);
      ASSERT_LT(error.cwiseAbs().maxCoeff(), 1e-3F) << d.transpose();  // float rounding
    }
  }
}

TEST(CubeLight, RgbdHoldsMoreThanEightBits) {
  Image face(5, 1, 3);
  const float values[] = {0, 0.02F, 0.9F, 37, 300};
  for (int x = 0; x < 5; ++x) {
    for (int c = 0; c < 3; ++c) face(x, 0, c) = values[x] / static_cast<float>(c + 1);
  }
  const ByteImage rgbd = encode_rgbd(face);
  for (int x = 0; x < 5; ++x) {
    for (int c = 0; c < 3; ++c) {
      const double stored = rgbd(x, 0, c) / 255.0;
      const double divisor = rgbd(x, 0, 3) / 255.0;
      const double half_step = 2.2 * std::pow(stored, 1.2) * (0.5 / 255) / divisor;
      EXPECT_NEAR(std::pow(stored, 2.2) / divisor, std::min(kLargestRgbd, face(x, 0, c)), 1.1 * half_step + 1e-5) << x;
    }
    // The brightest channel keeps at least half of the range, or all that 1 leaves.
    EXPECT_GE(rgbd(x, 0, 3), values[x] < 128 ? 255 / std::max(1.0F, 2 * values[x]) : 1) << x;
  }
}

// The formula that Babylon.js draws, in the cube's axes and with its signs, against the integral.
TEST(SceneFiles, GltfIrradianceIsTheIntegral) {
  const EnvMap map = three_lobes();
  const Eigen::MatrixX3d found = gltf_irradiance_coefficients(sh::project(map, 2));
  const auto drawn = [&found](const Eigen::Vector3d& n) -> Eigen::Vector3d {
    const double x = -n.x();
    const double y = n.y();
    const double z = n.z();
    Eigen::Matrix<double, 9, 1> basis;
    basis << 0.282095, -0.488603 * y, 0.488603 * z, -0.488603 * x, 1.092548 * x * y, -1.092548 * y * z,
        0.315392 * (3 * z * z - 1), -1.092548 * x * z, 0.546274 * (x * x - y * y);
    return found.transpose() * basis;
  };
  for (const Eigen::Vector3d& normal : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.3, 0.8, 0.5),
                                        Eigen::Vector3d(-0.6, -0.2, 0.7), Eigen::Vector3d(0.1, -0.4, -0.9)}) {
    const Eigen::Vector3d n = normal.normalized();
    Eigen::Vector3d integral = Eigen::Vector3d::Zero();
    for (int y = 0; y < map.height(); ++y) {
      for (int x = 0; x < map.width(); ++x) {
        const double cosine = std::max(0.0, n.dot(map.direction(x, y).cast<double>()));
        const float* p = map.radiance().pixel(x, y);
        integral += cosine * texel_solid_angle(y, 256, 128) * Eigen::Vector3d(p[0], p[1], p[2]);
      }
    }
    // What order 2 leaves of the lobes' irradiance: 1 % of what the brightest normal gets.
    EXPECT_LT((drawn(n) - integral).cwiseAbs().maxCoeff(), 0.05) << n.transpose();
  }
  EXPECT_THROW(gltf_irradiance_coefficients(Eigen::MatrixX3d::Zero(4, 3)), std::invalid_argument);
}

// Every number of an array that another points to is there, and each image is a PNG of the level's size.
TEST(SceneFiles, TheGltfIsWholeAndItsLampShinesFromWhereItIs) {
  const EstimateOptions options;
  const LightResult light = lamp_light(options, {1, 0.5F, 0.3F});
  const std::string text = gltf_scene(light, rest_of_environment(light, options));
  EXPECT_LT(text.size(), 300'000U);
  const json gltf = json::parse(text);
  EXPECT_EQ(gltf.at("asset").at("version"), "2.0");
  for (const auto& [name, extension] : gltf.at("extensions").items()) {
    const json& used = gltf.at("extensionsUsed");
    EXPECT_NE(std::find(used.begin(), used.end(), name), used.end()) << name;
  }
  const json& scene = gltf.at("scenes").at(gltf.at("scene").get<std::size_t>());
  const json& image_based = gltf.at("extensions").at("EXT_lights_image_based").at("lights");
  const json& environment =
      image_based.at(scene.at("extensions").at("EXT_lights_image_based").at("light").get<std::size_t>());
  EXPECT_EQ(environment.at("irradianceCoefficients").size(), 9U);
  for (const json& triple : environment.at("irradianceCoefficients")) EXPECT_EQ(triple.size(), 3U);
  std::size_t size = environment.at("specularImageSize").get<std::size_t>();
  std::size_t images = 0;
  for (const json& level : environment.at("specularImages")) {
    ASSERT_EQ(level.size(), 6U);
    for (const json& number : level) {
      ++images;
      const std::string uri = gltf.at("images").at(number.get<std::size_t>()).at("uri");
      // Signature and header, which has width and height, are the first 24 bytes, 32 characters of base 64.
      constexpr std::size_t kHead = sizeof("data:image/png;base64,") - 1 + 32;
      const auto side = static_cast<int>(size);
      EXPECT_EQ(uri.substr(0, kHead), io::png_data_uri(ByteImage(side, side, 4)).substr(0, kHead));
    }
    size /= 2;
  }
  EXPECT_EQ(images, gltf.at("images").size());
  EXPECT_EQ(size, 4U);  // the last level is 8 wide

  const json& node = gltf.at("nodes").at(scene.at("nodes").at(0).get<std::size_t>());
  const json& lamps = gltf.at("extensions").at("KHR_lights_punctual").at("lights");
  const json& lamp = lamps.at(node.at("extensions").at("KHR_lights_punctual").at("light").get<std::size_t>());
  EXPECT_EQ(lamp.at("type"), "directional");
  const std::vector<double> q = node.at("rotation");
  // Lamps shine along their own -z.
  const Eigen::Vector3d towards = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d::UnitZ();
  EXPECT_LT((towards - light.lights[0].direction).norm(), 1e-9);
  for (int c = 0; c < 3; ++c) {
    const double colour = lamp.at("color")[static_cast<std::size_t>(c)];
    EXPECT_LE(colour, 1);
    EXPECT_NEAR(colour * lamp.at("intensity").get<double>(), light.lights[0].irradiance * light.lights[0].colour[c],
                1e-9);
  }
}

TEST(SceneFiles, AGltfOfLightBeyondRgbdPutsTheScaleIntoItsIntensity) {
  const EstimateOptions options;
  lighting::Light even;
  const SphereGrid grid(options.solve.nside);
  even.radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 1020);
  even.confidence = Eigen::VectorXf::Ones(grid.cell_count());
  even.ambient.setConstant(1020);
  const LightResult light = light_result(std::move(even), options);
  const json gltf = json::parse(gltf_scene(light, light.environment));
  EXPECT_FALSE(gltf.contains("nodes"));
  const json& environment = gltf.at("extensions").at("EXT_lights_image_based").at("lights")[0];
  const double intensity = environment.at("intensity");
  EXPECT_NEAR(intensity, 4, 0.01);
  // Irradiance of even light is pi times it.
  const double first = environment.at("irradianceCoefficients")[0][0];
  EXPECT_NEAR(intensity * first * 0.282095, kPi * 1020, 0.01 * kPi * 1020);
}

}  // namespace
}  // namespace faceprobe::pipeline
