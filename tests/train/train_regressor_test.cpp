#include "faceprobe/train/train_regressor.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/region.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/net/face_window.h"
#include "faceprobe/net/light_regressor.h"
#include "faceprobe/synth/shard.h"
#include "faceprobe/train/map_crops.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace faceprobe::train {
namespace {

using testing::expect_error;

constexpr int kDiscPx = 20;

EnvMap lamp_in_room(const Eigen::Vector3f& towards, float strength, int height) {
  EnvMap map(2 * height, height);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const bool lamp = map.direction(x, y).dot(towards.normalized()) > std::cos(static_cast<float>(radians(14)));
      for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = lamp ? strength : 0.3F;
    }
  }
  return map;
}

// A round room whose wall has another colour wherever one looks: a crop's colour says how the camera is turned, and so where the lamp is.
EnvMap painted_room() {
  EnvMap map = lamp_in_room({0, 0.7F, 1}, 60, 32);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::Vector3f d = map.direction(x, y);
      const float azimuth = std::atan2(d.x(), d.z());
      for (int c = 0; c < 3; ++c) {
        const float phase = azimuth - static_cast<float>(c) * 2.0943951F;
        map.radiance()(x, y, c) += 0.4F * (1 + std::cos(phase));
      }
    }
  }
  return map;
}

// A matt ball that fills a disc's picture, under a lamp somewhere in front.
struct LitBall {
  Image linear{kDiscPx, kDiscPx, 3};
  EnvMap environment;
  Eigen::Vector3f towards;

  explicit LitBall(Random& random)
      : towards(Eigen::Vector3d(random.between(-1, 1), random.between(-0.7, 0.9), 0.7).normalized().cast<float>()) {
    environment = lamp_in_room(towards, 12, 16);
    for (int y = 0; y < kDiscPx; ++y) {
      for (int x = 0; x < kDiscPx; ++x) {
        const float u = (2 * static_cast<float>(x) + 1) / kDiscPx - 1;
        const float v = 1 - (2 * static_cast<float>(y) + 1) / kDiscPx;
        const Eigen::Vector3f normal = Eigen::Vector3f(0.7F * u, 0.7F * v, 0.6F).normalized();
        for (int c = 0; c < 3; ++c) linear(x, y, c) = 0.15F + 0.7F * std::max(0.0F, normal.dot(towards));
      }
    }
  }
};

void write_balls(const std::filesystem::path& folder, int count, std::uint64_t seed,
                 const std::vector<synth::NearLight>& lamps = {}) {
  Random random({seed});
  synth::ViewSamples balls;
  balls.view.normal = Image(kDiscPx, kDiscPx, 3);
  balls.view.depth_m = Image(kDiscPx, kDiscPx, 1, 1.0F);
  balls.view.region = ByteImage(kDiscPx, kDiscPx, 1, static_cast<std::uint8_t>(Region::kCheeks));
  balls.view.owner = ByteImage(kDiscPx, kDiscPx, 1, 1);
  balls.view.faces.resize(1);
  for (int i = 0; i < count; ++i) {
    const LitBall ball(random);
    synth::Sample sample;
    sample.photo = encode_srgb(ball.linear);
    sample.clip = ByteImage(kDiscPx, kDiscPx, 1);
    sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(kDiscPx, kDiscPx, 3);
    sample.environment = ball.environment;
    sample.lamps = lamps;
    sample.settings_json = "{}";
    balls.samples.push_back(std::move(sample));
  }
  const synth::ShardWriter writer(folder, {.size_px = kDiscPx, .environment_height = 16, .recipe = R"({"seed":1})"});
  writer.write(0, std::vector<synth::ViewSamples>{balls});
  writer.finish(1, "");
}

// Where light comes from as a whole.
Eigen::Vector3d mean_direction(const Eigen::MatrixX3f& light) {
  const SphereGrid grid = SphereGrid::of_cells(light.rows());
  return (grid.directions().transpose() * light.col(1)).cast<double>();
}

std::string bytes_in(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class TrainRegressorTest : public ::testing::Test {
 protected:
  TrainRegressorTest() {
    run_.config = {.picture_px = 16,
                   .widths = {8, 16},
                   .features = 32,
                   .light_size = 16,
                   .examples = 320,
                   .batch = 16,
                   .epochs = 12,
                   .learning_rate = 6e-3,
                   .average_decay = 0.95,
                   .drop = 0,
                   .colour_jitter = 0};
    run_.folder = folder_ / "run";
    run_.threads = 1;
  }

  // As run_, for the network that looks at faces.
  RegressorRun face_run() const {
    RegressorRun run = run_;
    run.config.light_size = 4;
    return run;
  }

  testing::TempFolder folder_;
  RegressorRun run_;
};

constexpr double kCell_deg = 7.3;  // of the 768 directions in which lights are compared in training
constexpr double kNotLearnt_deg = 20;

TEST_F(TrainRegressorTest, GardnerLearnsWhereTheLampIs) {
  run_.config.epochs = 18;
  run_.config.mask_share = 0.5;
  const GardnerData data{{painted_room()}, {painted_room()}};
  const RegressorReport report = train_gardner(data, run_);
  ASSERT_EQ(report.rows.size(), 18U);
  const RegressorRow& last = report.rows.back();
  EXPECT_LT(report.rows[8].loss,
            report.rows[0].loss);             // of the mask, though its lobe has narrowed, which makes it harder
  EXPECT_LT(last.loss, report.rows[9].loss);  // of the brightness
  // Who always answers with the mean light is off by more than kNotLearnt_deg: half its error, and two cells of direction, are learnt.
  EXPECT_LT(last.validation.diffuse, 0.5 * report.usual.diffuse);
  EXPECT_LT(last.validation.direction_deg, 2 * kCell_deg);
  EXPECT_GT(report.usual.direction_deg, kNotLearnt_deg);

  const net::LightRegressor regressor(report.weights);
  double off = 0;
  for (int i = 0; i < 12; ++i) {
    const MapCropOptions view{.px = 16, .yaw_rad = 0.5F * static_cast<float>(i)};
    const Eigen::MatrixX3f truth =
        grid_from_env_map(map_of_crop(data.training[0], view), SphereGrid(net::LightRegressor::kNside));
    off +=
        angle_between_deg(mean_direction(regressor.light(crop_of_map(data.training[0], view))), mean_direction(truth)) /
        12;
  }
  EXPECT_LT(off, 2 * kCell_deg);
}

TEST_F(TrainRegressorTest, LegendreLearnsWhereTheLampIs) {
  write_balls(folder_ / "train", 320, 1);
  write_balls(folder_ / "dev", 60, 2);
  const RegressorReport report = train_legendre({folder_ / "train", folder_ / "dev"}, face_run());
  ASSERT_EQ(report.rows.size(), 12U);
  const RegressorRow& last = report.rows.back();
  EXPECT_LT(last.loss, 0.5 * report.rows[0].loss);
  EXPECT_LT(last.validation.diffuse, 0.5 * report.usual.diffuse);  // as above; a ball tells more than a room
  EXPECT_LT(last.validation.direction_deg, 1.5 * kCell_deg);
  EXPECT_GT(report.usual.direction_deg, kNotLearnt_deg);

  const net::LightRegressor regressor(report.weights);
  Random random({3});
  double off = 0;
  for (int i = 0; i < 12; ++i) {
    const LitBall ball(random);
    const std::optional<Window> window = net::face_window(ByteImage(kDiscPx, kDiscPx, 1, 1), regressor.picture_px());
    const Eigen::MatrixX3f light = regressor.light(resampled(ball.linear, *window, Outside::kEdge));
    const Eigen::MatrixX3f truth = grid_from_env_map(ball.environment, SphereGrid(net::LightRegressor::kNside));
    off += angle_between_deg(mean_direction(light), mean_direction(truth)) / 12;
  }
  EXPECT_LT(off, 1.5 * kCell_deg);
}

TEST_F(TrainRegressorTest, TheSameSeedGivesTheSameBytes) {
  const GardnerData data{{painted_room()}, {}};
  run_.config.examples = 40;
  run_.config.epochs = 2;
  const std::string once = bytes_in(train_gardner(data, run_).weights);
  run_.folder = folder_ / "again";
  EXPECT_EQ(bytes_in(train_gardner(data, run_).weights), once);
  run_.config.seed = 2;
  run_.folder = folder_ / "other";
  EXPECT_NE(bytes_in(train_gardner(data, run_).weights), once);
}

TEST_F(TrainRegressorTest, WhatCannotBeLearntFromIsASentence) {
  expect_error(ExitCode::kInput, {"map"}, [&] { train_gardner({}, run_); });
  expect_error(ExitCode::kInput, {}, [&] { train_legendre({folder_ / "none", {}}, face_run()); });
  // Lamps in a room are no map's light.
  write_balls(folder_ / "lamps", 2, 1, {synth::NearLight{.position = {0, 0, 1}, .radiance = {1, 1, 1}}});
  expect_error(ExitCode::kInput, {"no face under a map"}, [&] { train_legendre({folder_ / "lamps", {}}, face_run()); });
}

TEST_F(TrainRegressorTest, AConfigThatTheNetworkDoesNotTakeIsASentence) {
  run_.config.light_size = 12;  // a panorama doubles three times
  expect_error(ExitCode::kUsage, {"light_size"}, [&] { train_gardner({{painted_room()}, {}}, run_); });
  run_.config.light_size = 16;
  run_.config.picture_px = 18;
  expect_error(ExitCode::kUsage, {"picture_px"}, [&] { train_gardner({{painted_room()}, {}}, run_); });
  run_.config.epochs = 0;
  expect_error(ExitCode::kUsage, {"epochs"}, [&] { train_gardner({{painted_room()}, {}}, run_); });
}

TEST(RegressorConfig, ComesBackFromItsText) {
  RegressorConfig config = legendre_config();
  config.widths = {8, 24};
  config.mirror_weight = 0.3;
  config.seed = 11;
  const RegressorConfig again = regressor_config_from_json(to_json(config), {});
  EXPECT_EQ(to_json(again), to_json(config));
  EXPECT_EQ(again.widths, config.widths);
  // What is not named stays as it was.
  EXPECT_EQ(to_json(regressor_config_from_json("{}", config)), to_json(config));
}

TEST(RegressorConfig, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"[]", R"({"epoch": 3})", R"({"epochs": "many"})", R"({"epochs": 0})", R"({"drop": 1.0})",
                           R"({"learning_rate": -1})", R"({"largest_exponent": 0.5})", R"({"widths": "wide"})"}) {
    EXPECT_THROW(regressor_config_from_json(text, {}), Error) << text;
  }
}

}  // namespace
}  // namespace faceprobe::train
