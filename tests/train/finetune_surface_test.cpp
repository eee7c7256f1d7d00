#include "faceprobe/train/finetune_surface.h"

#include "faceprobe/net/model_file.h"
#include "net/face_outputs.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"
#include "train/small_data.h"
#include "train/small_person.h"

#include <gtest/gtest.h>
#include <cmath>
#include <fstream>

namespace faceprobe::train {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

PersonSet small_set(const std::string& name, float redness) {
  const testing::Person person = testing::make_person(redness);
  PersonSet set{.name = name, .photos = {}, .masks = {}, .meshes = {}, .regions = person.regions, .left_out = {}};
  for (const PersonPhoto& photo : person.photos) {
    set.photos.push_back(std::make_shared<const PersonPhoto>(photo));
    set.masks.emplace_back(photo.linear.width(), photo.linear.height(), 1, std::uint8_t{1});
    set.meshes.emplace_back(photo.linear.width(), photo.linear.height(), 3);
  }
  return set;
}

class FinetuneSurfaceTest : public ::testing::Test {
 protected:
  FinetuneSurfaceTest() {
    torch::manual_seed(3);
    const net::UNetOptions options{.in_channels = net::FaceInputs::kCount,
                                   .out_channels = net::FaceOutputs::kCount,
                                   .widths = {8, 16},
                                   .convs_per_level = 2};
    net::UNet unet(options);
    {
      // It knows skin, and nothing else.
      const torch::NoGradGuard no_gradients;
      constexpr int kPlaces = net::kFold * net::kFold;
      constexpr int kCheeks = net::FaceOutputs::kRegion + static_cast<int>(Region::kCheeks);
      unet->named_parameters()["head.bias"].narrow(0, kPlaces * kCheeks, kPlaces).fill_(50);
    }
    net::save_weights(*unet, start(),
                      {{net::kArchitectureKey, net::kFaceArchitecture}, {net::kOptionsKey, net::options_json(options)}},
                      false);
  }
  std::filesystem::path start() const { return folder_ / "start.safetensors"; }
  FinetuneSurfaceRun run(int people) const {
    FinetuneSurfaceRun run;
    for (int i = 0; i < people; ++i)
      run.people.push_back(small_set("people/" + std::to_string(i), 0.5F + 0.05F * static_cast<float>(i)));
    run.start = start();
    run.folder = folder_ / "run";
    run.threads = 1;
    run.config.photos = 3;
    run.config.synthetic_batch = 0;
    run.config.steps = 60;
    run.config.learning_rate = 2e-3;
    run.config.held_out_share = 0.4;
    return run;
  }
  TempFolder folder_;
};

// From random weights, whose shading has nothing to do with their normals.
TEST_F(FinetuneSurfaceTest, LayersOfPeopleItDidNotSeeHangTogetherBetter) {
  const FinetuneSurfaceReport report = finetune_surface(run(6), {});
  EXPECT_TRUE(report.finished);
  EXPECT_FALSE(report.validated);
  EXPECT_GE(report.before.people, 1);
  EXPECT_LT(report.before.people, 6);
  EXPECT_NEAR(report.before.normal_change_deg, 0, 0.1);
  // The contrast that may go for nothing is worth a fifth of the residual.
  EXPECT_LT(report.after.residual, 0.95 * report.before.residual);
  // Not by the ways that the guards close: twice their slack, for they are weighed, not walls.
  EXPECT_GT(report.after.contrast, 0.6 * report.before.contrast);
  EXPECT_GT(report.after.confidence, 0.5 * report.before.confidence);
  EXPECT_GT(report.after.normal_change_deg, 0);
  EXPECT_LT(report.after.normal_change_deg, 12);
  EXPECT_EQ(report.rows.size(), 6U);
  EXPECT_EQ(report.rows.back().lights, 0);
  const net::ModelInfo made = net::read_model_info(report.weights);
  EXPECT_EQ(made.architecture, net::kFaceArchitecture);
  EXPECT_NE(made.metadata.at("finetune_surface").find("\"order\": 4"), std::string::npos);
  std::ifstream log(folder_ / "run" / "log.csv");
  std::string line;
  int lines = 0;
  while (std::getline(log, line)) ++lines;
  EXPECT_EQ(lines, 7);
}

TEST_F(FinetuneSurfaceTest, PhotosUnderOneLightSyntheticFacesAndTheirErrorsTakePart) {
  const DataFolder faces("finetune_surface", 32, 4);
  FinetuneSurfaceRun whole = run(4);
  whole.config.steps = 5;
  whole.config.synthetic_batch = 2;
  whole.lights.push_back(small_set("studio", 0.6F));
  whole.synthetic = whole.validation = faces.data();
  const FinetuneSurfaceReport report = finetune_surface(whole, {});
  ASSERT_EQ(report.rows.size(), 1U);
  EXPECT_GT(report.rows[0].lights, 0);
  EXPECT_GT(report.rows[0].synthetic_loss, 0);
  EXPECT_TRUE(report.validated);
  EXPECT_GT(report.dev_before.normal_deg, 0);
  EXPECT_NE(report.dev_after.normal_deg, report.dev_before.normal_deg);
  // The same run gives the same weights.
  const std::string first = net::read_model_info(report.weights).sha256;
  EXPECT_EQ(net::read_model_info(finetune_surface(whole, {}).weights).sha256, first);
}

TEST_F(FinetuneSurfaceTest, AStopIsObeyed) {
  int asked = 0;
  const FinetuneSurfaceReport report = finetune_surface(run(4), {.progress = {}, .stop = [&] { return ++asked > 20; }});
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(report.rows.size(), 2U);
}

TEST_F(FinetuneSurfaceTest, WhatCannotBeUsedIsRefused) {
  expect_error(ExitCode::kInput, {"held out", "1 people"}, [&] { finetune_surface(run(1), {}); });
  FinetuneSurfaceRun bad = run(4);
  bad.config.photos = 1;
  expect_error(ExitCode::kUsage, {"photos is 1", "2 to 64"}, [&] { finetune_surface(bad, {}); });
  bad = run(4);
  bad.config.rerender.normal_slack_deg = 0;
  expect_error(ExitCode::kUsage, {"normal_slack_deg is 0", "0.1 to 90"}, [&] { finetune_surface(bad, {}); });
  bad = run(4);
  bad.start = folder_ / "unet.safetensors";
  const net::UNetOptions options{.widths = {8, 16}};
  net::save_weights(*net::UNet(options), bad.start,
                    {{net::kArchitectureKey, net::kUNetArchitecture}, {net::kOptionsKey, net::options_json(options)}},
                    true);
  expect_error(ExitCode::kInput, {"unet", "face"}, [&] { finetune_surface(bad, {}); });
}

}  // namespace
}  // namespace faceprobe::train
