#include "faceprobe/train/map_crops.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kHeight = 128;
constexpr double kTexelDeg = 180.0 / kHeight;

// A grey room with a round lamp, as wide as ten texels.
EnvMap room_with_lamp(const Eigen::Vector3f& towards, float strength = 50) {
  EnvMap map(2 * kHeight, kHeight);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const bool lamp = map.direction(x, y).dot(towards.normalized()) > std::cos(static_cast<float>(radians(5)));
      for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = lamp ? strength : 1;
    }
  }
  return map;
}

// Middle of the pixels that are white, from the top left corner.
Eigen::Vector2f white_middle(const Image& crop) {
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  float count = 0;
  for (int y = 0; y < crop.height(); ++y) {
    for (int x = 0; x < crop.width(); ++x) {
      if (crop(x, y, 0) < 1) continue;
      sum += Eigen::Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
      ++count;
    }
  }
  return sum / count;
}

// Where the map holds the most light, as a mean over what is far above the room.
Eigen::Vector3f brightest(const EnvMap& map) {
  const SphereGrid grid(16);
  const Eigen::MatrixX3f light = grid_from_env_map(map, grid);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const float room = light.col(0).minCoeff();
  for (int i = 0; i < grid.cell_count(); ++i) {
    if (light(i, 0) > 1.5F * room) sum += (light(i, 0) - room) * grid.direction(i);
  }
  return sum.normalized();
}

void expect_towards(const Eigen::Vector3f& found, const Eigen::Vector3f& truth) {
  EXPECT_LT(angle_between_deg(found.cast<double>(), truth.cast<double>()), kTexelDeg)
      << found.transpose() << " and " << truth.transpose();
}

TEST(MapCrops, ALampAheadIsInTheMiddle) {
  const EnvMap map = room_with_lamp({0, 0, -1});
  const MapCropOptions options{.px = 64};
  const Image crop = crop_of_map(map, options);
  ASSERT_EQ(crop.width(), 64);
  ASSERT_EQ(crop.height(), 64);
  ASSERT_EQ(crop.channels(), 3);
  EXPECT_LT((white_middle(crop) - Eigen::Vector2f(32, 32)).norm(), 0.5F);
  const SphereGrid grid(16);
  const Eigen::MatrixX3f light = grid_from_env_map(map_of_crop(map, options), grid);
  ASSERT_EQ(light.rows(), grid.cell_count());
  Eigen::Index cell = 0;
  light.col(1).maxCoeff(&cell);
  EXPECT_GT(grid.direction(static_cast<int>(cell)).dot(Eigen::Vector3f(0, 0, -1)),
            std::cos(2 * static_cast<float>(grid.cell_radius())));
  expect_towards(brightest(map_of_crop(map, options)), {0, 0, -1});
}

// A pinhole camera: the tangent of the angle to the right is the share of half the width.
TEST(MapCrops, ALampAtTheRightIsAtTheRight) {
  const float angle = 0.3F;
  const EnvMap map = room_with_lamp({std::sin(angle), 0, -std::cos(angle)});
  const MapCropOptions options{.px = 64, .field_of_view_rad = 1.2F};
  const Eigen::Vector2f middle = white_middle(crop_of_map(map, options));
  // The lamp's picture is an ellipse whose middle lies a little further out than the lamp's.
  EXPECT_NEAR(middle.x(), 32 + 32 * std::tan(angle) / std::tan(0.6F), 1);
  EXPECT_NEAR(middle.y(), 32, 0.5);
  expect_towards(brightest(map_of_crop(map, options)), {std::sin(angle), 0, -std::cos(angle)});
}

TEST(MapCrops, ALampAboveIsAbove) {
  const EnvMap map = room_with_lamp({0, 0.25F, -1});
  const Eigen::Vector2f middle = white_middle(crop_of_map(map, {.px = 64}));
  EXPECT_NEAR(middle.x(), 32, 0.5);
  EXPECT_LT(middle.y(), 24);
}

// The crop and the light turn alike, and as the header says.
TEST(MapCrops, YawAndPitchTurnTheMap) {
  const MapCropOptions options{.px = 64, .yaw_rad = 0.9F, .pitch_rad = 0.2F};
  const Eigen::Vector3f ahead(0, 0, -1);
  const Eigen::Vector3f in_map =
      Eigen::AngleAxisf(-0.9F, Eigen::Vector3f::UnitY()) * (Eigen::AngleAxisf(-0.2F, Eigen::Vector3f::UnitX()) * ahead);
  const EnvMap map = room_with_lamp(in_map);
  EXPECT_LT((white_middle(crop_of_map(map, options)) - Eigen::Vector2f(32, 32)).norm(), 1);
  expect_towards(brightest(map_of_crop(map, options)), ahead);
  // What is ahead goes to the left, and up.
  const EnvMap plain = room_with_lamp(ahead);
  const Eigen::Vector2f middle = white_middle(crop_of_map(plain, {.px = 64, .yaw_rad = 0.2F, .pitch_rad = 0.2F}));
  EXPECT_LT(middle.x(), 28);
  EXPECT_LT(middle.y(), 28);
}

TEST(MapCrops, TheMeanIsSetByTheExposure) {
  const EnvMap map = room_with_lamp({0, 0, 1});  // behind the camera
  for (const float exposure : {0.5F, 1.0F, 1.7F}) {
    const Image crop = crop_of_map(map, {.px = 16, .exposure = exposure});
    EXPECT_NEAR(crop(3, 3, 1), 0.35F * exposure, 0.005);  // half a step of 8 bits
  }
  // With a lamp in view the rest is not darkened for its sake.
  const EnvMap lamp = room_with_lamp({0, 0, -1}, 5000);
  const Image crop = crop_of_map(lamp, {.px = 64});
  double sum = 0;
  for (const float value : crop.values()) sum += static_cast<double>(value);
  EXPECT_NEAR(sum / static_cast<double>(crop.values().size()), 0.35, 0.005);
  EXPECT_GT(crop(2, 2, 0), 0.25F);
}

TEST(MapCrops, IsWhatACameraWrites) {
  const Image crop = crop_of_map(room_with_lamp({0.2F, 0.1F, -1}), {.px = 32});
  EXPECT_EQ(decode_srgb(encode_srgb(crop)), crop);  // of 8 bits
  for (const float value : crop.values()) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

// What the crop shows unclipped has the same number in its light.
TEST(MapCrops, TheLightIsOnTheCropsScale) {
  const EnvMap map = room_with_lamp({0, 0, 1});
  const MapCropOptions options{.px = 16, .exposure = 1.3F};
  const SphereGrid grid(16);
  const Eigen::MatrixX3f light = grid_from_env_map(map_of_crop(map, options), grid);
  EXPECT_NEAR(light(grid.cell_of({0, 0, -1}), 1), crop_of_map(map, options)(8, 8, 1), 0.01);
  EXPECT_NEAR(light(grid.cell_of({0, 0, 1}), 1), 50 * 0.35 * 1.3, 0.2);  // unclipped
}

TEST(MapCrops, RefusesWhatIsNoCamera) {
  const EnvMap map = room_with_lamp({0, 0, 1});
  EXPECT_THROW(crop_of_map(EnvMap(), {}), std::invalid_argument);
  EXPECT_THROW(crop_of_map(map, {.px = 0}), std::invalid_argument);
  EXPECT_THROW(crop_of_map(map, {.field_of_view_rad = 3.2F}), std::invalid_argument);
  EXPECT_THROW(crop_of_map(map, {.field_of_view_rad = 0}), std::invalid_argument);
  EXPECT_THROW(crop_of_map(map, {.exposure = 0}), std::invalid_argument);
  EXPECT_THROW(map_of_crop(EnvMap(), {}), std::invalid_argument);
}

// Black stays black, and is nothing to divide by.
TEST(MapCrops, ABlackMapIsABlackCrop) {
  const Image crop = crop_of_map(EnvMap(32, 16), {.px = 8});
  for (const float value : crop.values()) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace faceprobe::train
