// A written map read by other tools' own formulas. Each formula is the tool's, in the tool's axes; a lamp at camera right has to be
// at the right of that tool's default camera.

#include "faceprobe/core/angles.h"
#include "faceprobe/io/picture_file.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <ostream>

namespace faceprobe::pipeline {
namespace {

// u from the left, v from the top, both 0..1.
using Lookup = Eigen::Vector2d (*)(const Eigen::Vector3d&);

// three.js, equirectUv in common.glsl.js: v counts from the bottom. Camera: looks along -z, +x right, +y up.
Eigen::Vector2d three(const Eigen::Vector3d& d) {
  return {std::atan2(d.z(), d.x()) / (2 * kPi) + 0.5, 1 - (std::asin(std::clamp(d.y(), -1.0, 1.0)) / kPi + 0.5)};
}

// Blender, direction_to_equirectangular in Cycles' projection.h: v counts from the bottom. Front view: looks along +y, +x right, +z up.
Eigen::Vector2d blender(const Eigen::Vector3d& d) {
  return {-std::atan2(d.y(), d.x()) / (2 * kPi) + 0.5, 1 - (std::atan2(d.z(), std::hypot(d.x(), d.y())) / kPi + 0.5)};
}

// OpenEXR, LatLongMap in ImfEnvmap.cpp: latitude pi/2 is the top row, longitude +pi the left column. Camera as three.js's.
Eigen::Vector2d open_exr(const Eigen::Vector3d& d) {
  return {std::atan2(d.x(), d.z()) / (-2 * kPi) + 0.5, std::asin(d.y()) / -kPi + 0.5};
}

// Debevec's high-resolution light probes: u in [0, 2] gives theta = pi (u - 1), v in [0, 1] gives phi = pi v, and the direction is
// (sin phi sin theta, cos phi, -sin phi cos theta). Inverted here.
Eigen::Vector2d debevec(const Eigen::Vector3d& d) {
  return {(std::atan2(d.x(), -d.z()) / kPi + 1) / 2, std::acos(d.y()) / kPi};
}

struct Tool {
  const char* name;
  Orientation orientation;
  Lookup lookup;
  Eigen::Matrix3d axes;  // tool_from_portrait: the portrait camera's frame in the tool's, both cameras looking ahead
};
void PrintTo(const Tool& tool, std::ostream* stream) { *stream << tool.name; }  // GoogleTest's name for this

const Eigen::Matrix3d kSame = Eigen::Matrix3d::Identity();
// Right stays +x; the portrait's up (+y) is Blender's +z; towards the viewer (+z) is Blender's -y.
const Eigen::Matrix3d kZUp = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished();

class Export : public ::testing::TestWithParam<Tool> {};

// Red at camera right, green towards the viewer, blue up: a flip or a wrong roll misplaces at least one.
EnvMap three_lamps() {
  EnvMap map(128, 64);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        const Eigen::Vector3d lamp = std::array{Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1),
                                                Eigen::Vector3d(0, 1, 0)}[static_cast<std::size_t>(c)];
        map.radiance()(x, y, c) = angle_between_deg(map.direction(x, y).cast<double>(), lamp) < 15 ? 8.0F : 0.25F;
      }
    }
  }
  return map;
}

TEST_P(Export, LampsAreWhereTheToolsOwnFormulaLooksForThem) {
  const Tool& tool = GetParam();
  const testing::TempFolder folder;
  for (const char* extension : {".exr", ".hdr"}) {
    const std::filesystem::path path = folder.path() / (std::string("map") + extension);
    io::write_env_map(path, three_lamps(), tool.orientation);
    const Image file = io::read_linear_picture(path);
    const auto at = [&](const Eigen::Vector3d& portrait_direction) {
      const Eigen::Vector2d uv = tool.lookup(tool.axes * portrait_direction);
      const int x = std::min(static_cast<int>(uv.x() * file.width()), file.width() - 1);
      const int y = std::min(static_cast<int>(uv.y() * file.height()), file.height() - 1);
      return Eigen::Vector3f(file.pixel(x, y));
    };
    // RGBE keeps eight bits of the largest channel, half floats eleven of each; the values are exact in both.
    const Eigen::Vector3f red(8, 0.25F, 0.25F);
    const Eigen::Vector3f green(0.25F, 8, 0.25F);
    const Eigen::Vector3f blue(0.25F, 0.25F, 8);
    const Eigen::Vector3f none(0.25F, 0.25F, 0.25F);
    EXPECT_EQ(at({1, 0, 0}), red) << extension << ": camera right";
    EXPECT_EQ(at({-1, 0, 0}), none) << extension << ": camera left";
    EXPECT_EQ(at({0, 0, 1}), green) << extension << ": behind the camera";
    EXPECT_EQ(at({0, 0, -1}), none) << extension << ": in front of it";
    EXPECT_EQ(at({0, 1, 0}), blue) << extension << ": up";
    EXPECT_EQ(at({0, -1, 0}), none) << extension << ": down";
  }
}

TEST_P(Export, EveryDirectionIsTheNativeOneRolledByWholeQuarters) {
  const Tool& tool = GetParam();
  // Fibonacci points: even over the sphere, none on a seam.
  for (int i = 0; i < 500; ++i) {
    const double height = 1 - (2 * i + 1) / 500.0;
    const double turn = i * kPi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - height * height);
    const Eigen::Vector3d direction(radius * std::cos(turn), height, radius * std::sin(turn));
    const Eigen::Vector2d native = uv_from_direction(direction.cast<float>()).cast<double>();
    const Eigen::Vector2d theirs = tool.lookup(tool.axes * direction);
    double roll = theirs.x() - native.x() - 0.25 * static_cast<int>(tool.orientation);
    roll -= std::round(roll);
    EXPECT_NEAR(roll, 0, 1e-6);  // float of the native look-up
    EXPECT_NEAR(theirs.y(), native.y(), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Tools, Export,
                         ::testing::Values(Tool{"OpenExr", Orientation::kOpenExr, open_exr, kSame},
                                           Tool{"Three", Orientation::kThree, three, kSame},
                                           Tool{"Blender", Orientation::kThree, blender, kZUp},
                                           Tool{"Debevec", Orientation::kDebevec, debevec, kSame}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace faceprobe::pipeline
