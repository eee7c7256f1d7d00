#include "faceprobe/pipeline/scene_files.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"
#include "pipeline/light_result.h"

#include <gtest/gtest.h>

#include <regex>

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

}  // namespace
}  // namespace faceprobe::pipeline
