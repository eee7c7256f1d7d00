#include "faceprobe/train/train_sky.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/net/sky_regressor.h"
#include "faceprobe/train/map_crops.h"
#include "net/torch/sky_cnn.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"
#include "train/sky_examples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace faceprobe::train {
namespace {

using testing::expect_error;

// A sky of the model over a ground, as a map.
NamedMap sky_map(const SkyParameters& sky) {
  const SphereGrid grid(16);
  return {"sky at " + std::to_string(sky.sun_azimuth_deg), env_map_from_grid(sky_radiance(sky, grid), grid, 128, 64)};
}

std::vector<NamedMap> sky_maps(double first_azimuth_deg) {
  std::vector<NamedMap> maps;
  for (int i = 0; i < 4; ++i) {
    maps.push_back(sky_map({.sun_azimuth_deg = first_azimuth_deg + 70 * i,
                            .sun_elevation_deg = 30.0 + 8 * i,
                            .turbidity = 2.5 + i,
                            .exposure = 0.05}));
  }
  return maps;
}

struct TrainSkyTest : public ::testing::Test {
  TrainSkyTest() {
    run_.config = {
        .px = 32, .widths = {8, 8, 12, 12, 16, 16, 16}, .hidden = 48, .crops_per_map = 64, .epochs = 16, .drop = 0};
    run_.maps = sky_maps(0);
    run_.validation_maps = sky_maps(33);
    run_.folder = folder_ / "run";
    run_.threads = 1;
  }

  static std::string bytes(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  testing::TempFolder folder_;
  SkyRun run_;
};

TEST_F(TrainSkyTest, LearnsWhereTheSunStands) {
  const SkyReport report = train_sky(run_);
  ASSERT_EQ(report.rows.size(), 16U);
  // It learnt something: two thirds of what a constant answer is off by, and of the numbers' first error, are bounds that noise does not pass.
  EXPECT_LT(report.validation.median_deg, 0.6 * report.guess.median_deg);
  EXPECT_GT(report.validation.within_45, report.guess.within_45);
  EXPECT_LT(report.rows.back().validation.numbers, 0.7 * report.rows.front().validation.numbers);
  // The file that was written says the same.
  const net::SkyRegressor network(report.weights, 1);
  const SkyExamples examples = draw_sky_examples(run_.validation_maps, run_.config, 0x5c2, 1);
  ASSERT_EQ(examples.count(), 256);
  std::vector<double> errors;
  for (std::int64_t i = 0; i < examples.count(); ++i) {
    ByteImage encoded(32, 32, 3);
    std::copy_n(examples.pictures.data_ptr<std::uint8_t>() + i * 3072, 3072, encoded.data());
    const net::SkyEstimate found = network.estimate(decode_srgb(encoded));
    const Eigen::Vector3d truth =
        Eigen::Map<const Eigen::Vector3f>(examples.sun.data_ptr<float>() + 3 * i).cast<double>();
    errors.push_back(angle_between_deg(net::sun_of_shares(found.sun_share), truth));
  }
  std::ranges::sort(errors);
  EXPECT_NEAR((errors[127] + errors[128]) / 2, report.validation.median_deg, 0.5);  // sums of another order
}

TEST_F(TrainSkyTest, ExamplesSayWhatTheirCropsShow) {
  // A sky that fills the camera's view with the sun in it, in front of a camera that looks straight at it.
  const SkyParameters sky{.sun_azimuth_deg = 70, .sun_elevation_deg = 40, .turbidity = 3, .exposure = 0.05};
  const NamedMap map = sky_map(sky);
  run_.config.crops_per_map = 40;
  const SkyExamples examples = draw_sky_examples({map}, run_.config, 7, 2);
  ASSERT_EQ(examples.count(), 40);
  EXPECT_NEAR(examples.ground_albedo, 0.2, 0.05);  // read off a map that was resampled from 3072 cells
  const float* sun = examples.sun.data_ptr<float>();
  const float* numbers = examples.numbers.data_ptr<float>();
  const auto number = [&](int i, net::SkyNumber which) {
    return static_cast<double>(numbers[i * net::kSkyNumbers + static_cast<int>(which)]);
  };
  int turned_right = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d towards = Eigen::Map<const Eigen::Vector3f>(sun + 3 * i).cast<double>();
    EXPECT_NEAR(elevation_deg(towards), 40, 1.5);  // the map's texels are 2.8 degrees wide
    turned_right += azimuth_deg(towards) > 0 ? 1 : 0;
    EXPECT_NEAR(number(i, net::SkyNumber::kTurbidity), 3, 0.3);  // of the fit to that map, whose cells blur the horizon
    EXPECT_LE(std::abs(degrees(number(i, net::SkyNumber::kCameraElevation))), run_.config.most_pitch_deg);
  }
  EXPECT_GT(turned_right, 5);  // drawn from all around
  EXPECT_LT(turned_right, 35);
}

TEST_F(TrainSkyTest, LabelsAreInTheFrameAndScaleOfTheCropsLight) {
  const SkyParameters sky{.sun_azimuth_deg = 70, .sun_elevation_deg = 40, .turbidity = 3, .exposure = 0.05};
  const NamedMap map = sky_map(sky);
  const SphereGrid grid(16);
  for (const float yaw : {0.0F, 1.0F, -2.5F}) {
    const MapCropOptions view{.px = 32, .field_of_view_rad = 1, .yaw_rad = yaw, .pitch_rad = 0.2F, .exposure = 0.8F};
    const double gain = gain_of_crop(map.second, view, crop_of_map(map.second, view));
    // As the network's answer would be drawn: a positive pitch moves what is ahead up, so the camera looks down.
    SkyParameters seen = sky;
    seen.sun_azimuth_deg += degrees(static_cast<double>(yaw));
    seen.exposure *= gain;
    const Eigen::MatrixX3f drawn = sky_radiance(seen, grid, net::level_from_camera(-0.2));
    const Eigen::MatrixX3f truth = grid_from_env_map(map_of_crop(map.second, view), grid);
    double off = 0;
    double all = 0;
    for (int j = 0; j < grid.cell_count(); ++j) {
      const Eigen::Vector3f level = net::level_from_camera(-0.2) * grid.direction(j);
      if (std::abs(level.y()) < 0.1F || angle_between_deg(level.cast<double>(), sun_direction(seen)) < 15) continue;
      off += static_cast<double>((drawn.row(j) - truth.row(j)).cwiseAbs().sum());
      all += static_cast<double>(truth.row(j).sum());
    }
    EXPECT_LT(off, 0.03 * all) << yaw;  // texels of 2.8 degrees against cells of 3.7, and steps of 8 bits
    Eigen::Index there = 0;
    Eigen::Index here = 0;
    truth.col(1).maxCoeff(&there);
    drawn.col(1).maxCoeff(&here);
    const double apart = angle_between_deg(grid.direction(static_cast<int>(there)).cast<double>(),
                                           grid.direction(static_cast<int>(here)).cast<double>());
    EXPECT_LT(apart, 5.5) << yaw;  // neighbouring cells
  }
}

TEST_F(TrainSkyTest, TheSameSeedGivesTheSameBytes) {
  run_.config.epochs = 1;
  run_.config.drop = 0.3;
  run_.config.crops_per_map = 8;
  run_.validation_maps.clear();
  const SkyReport report = train_sky(run_);
  EXPECT_EQ(report.guess.median_deg, 0);
  const std::string once = bytes(report.weights);
  run_.folder = folder_ / "again";
  EXPECT_EQ(bytes(train_sky(run_).weights), once);
  run_.config.seed = 2;
  run_.folder = folder_ / "other";
  EXPECT_NE(bytes(train_sky(run_).weights), once);
}

TEST_F(TrainSkyTest, MapsWithoutASkyAreASentence) {
  run_.maps.clear();
  expect_error(ExitCode::kInput, {"no maps", "outdoor"}, [&] { train_sky(run_); });
  run_.maps.emplace_back("cellar", EnvMap(64, 32));
  expect_error(ExitCode::kInput, {"cellar", "Leave it out"}, [&] { train_sky(run_); });
}

TEST(SkyConfig, ComesBackFromItsText) {
  const SkyConfig config{.px = 64, .widths = {1, 2, 3, 4, 5, 6, 7}, .epochs = 3, .drop = 0.5, .seed = 11};
  const SkyConfig again = sky_config_from_json(to_json(config));
  EXPECT_EQ(to_json(again), to_json(config));
  EXPECT_EQ(again.widths, config.widths);
}

TEST(SkyConfig, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"[]", R"({"epoch": 3})", R"({"epochs": "many"})", R"({"epochs": 0})", R"({"widths": []})",
                           R"({"widths": [0, 1, 1, 1, 1, 1, 1]})", R"({"px": 100})", R"({"drop": 1.0})",
                           R"({"learning_rate": -1})", R"({"least_view_deg": 80, "most_view_deg": 60})"}) {
    EXPECT_THROW(sky_config_from_json(text), Error) << text;
  }
}

}  // namespace
}  // namespace faceprobe::train
