#include "faceprobe/train/finetune.h"

#include "faceprobe/net/model_file.h"
#include "net/torch/mscr.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"
#include "train/small_person.h"

#include <gtest/gtest.h>
#include <cmath>
#include <fstream>

namespace faceprobe::train {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

// People of one face whose colours differ.
std::vector<PersonSet> small_people(int count) {
  std::vector<PersonSet> people;
  for (int i = 0; i < count; ++i) {
    const testing::Person person = testing::make_person(0.5F + 0.05F * static_cast<float>(i));
    PersonSet set{.name = "people/" + std::to_string(i),
                  .photos = {},
                  .masks = {},
                  .meshes = {},
                  .regions = person.regions,
                  .left_out = {}};
    for (const PersonPhoto& photo : person.photos) {
      set.photos.push_back(std::make_shared<const PersonPhoto>(photo));
      set.masks.emplace_back(photo.linear.width(), photo.linear.height(), 1, std::uint8_t{1});
      set.meshes.emplace_back(photo.linear.width(), photo.linear.height(), 3);
    }
    people.push_back(std::move(set));
  }
  return people;
}

class FinetuneTest : public ::testing::Test {
 protected:
  FinetuneTest() {
    torch::manual_seed(3);
    const net::UNetOptions options{.widths = {8, 16}, .convs_per_level = 2};
    net::save_weights(*net::UNet(options), start(),
                      {{net::kArchitectureKey, net::kUNetArchitecture}, {net::kOptionsKey, net::options_json(options)}},
                      false);
  }
  std::filesystem::path start() const { return folder_ / "start.safetensors"; }
  FinetuneRun run(int people) const {
    FinetuneRun run;
    run.people = small_people(people);
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

// From random weights, on people who differ in colour alone: what is learnt on some lowers the residual of the others, without taking
// everything off.
TEST_F(FinetuneTest, LowersTheResidualOfPeopleItDidNotSee) {
  const FinetuneReport report = finetune_highlight(run(6), {});
  EXPECT_TRUE(report.finished);
  EXPECT_GE(report.before.people, 1);
  EXPECT_LT(report.before.people, 6);
  EXPECT_LT(report.after.residual,
            0.9 * report.before.residual);  // six steps: more than the residual's own noise of a few hundredths
  EXPECT_GT(report.after.energy, 0);
  EXPECT_LT(report.after.energy, 0.3);  // of photos whose mean is about 0.2: the diffuse layer did not go
  EXPECT_EQ(report.rows.size(), 6U);
  EXPECT_EQ(net::read_model_info(report.weights).architecture, net::kUNetArchitecture);
  std::ifstream log(folder_ / "run" / "log.csv");
  std::string line;
  int lines = 0;
  while (std::getline(log, line)) ++lines;
  EXPECT_EQ(lines, 7);
}

TEST_F(FinetuneTest, TheSameRunGivesTheSameWeights) {
  FinetuneRun once = run(4);
  once.config.steps = 5;
  finetune_highlight(once, {});
  const std::string first = net::read_model_info(once.folder / "weights.safetensors").sha256;
  finetune_highlight(once, {});
  EXPECT_EQ(net::read_model_info(once.folder / "weights.safetensors").sha256, first);
}

TEST_F(FinetuneTest, AStopIsObeyed) {
  int asked = 0;
  const FinetuneReport report = finetune_highlight(run(4), {.progress = {}, .stop = [&] { return ++asked > 20; }});
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(report.rows.size(), 2U);
}

TEST_F(FinetuneTest, WhatCannotBeUsedIsRefused) {
  expect_error(ExitCode::kInput, {"held out", "1 people"}, [&] { finetune_highlight(run(1), {}); });
  FinetuneRun bad = run(4);
  bad.config.photos = 1;
  expect_error(ExitCode::kUsage, {"photos is 1", "2 to 64"}, [&] { finetune_highlight(bad, {}); });
  bad = run(4);
  bad.config.mode = "wild";
  expect_error(ExitCode::kUsage, {"wild", "paper"}, [&] { finetune_highlight(bad, {}); });
  bad = run(4);
  bad.start = folder_ / "shi.safetensors";
  net::save_weights(*net::UNet(net::UNetOptions{.widths = {8, 16}}), bad.start,
                    {{net::kArchitectureKey, net::kShiArchitecture}, {net::kOptionsKey, "{}"}}, true);
  expect_error(ExitCode::kInput, {"shi", "unet, face and mscr"}, [&] { finetune_highlight(bad, {}); });
}

// The paper's own: its network, its loss. Two steps say that it runs, drops the same each time, and changes the weights.
TEST_F(FinetuneTest, ThePapersNetworkIsFinetunedToo) {
  FinetuneRun paper = run(4);
  paper.start = folder_ / "mscr.safetensors";
  torch::manual_seed(4);
  const net::MscrOptions options;
  net::save_weights(*net::Mscr(options), paper.start,
                    {{net::kArchitectureKey, net::kMscrArchitecture}, {net::kOptionsKey, net::options_json(options)}},
                    true);
  paper.config.mode = "paper";
  paper.config.steps = 2;
  const FinetuneReport report = finetune_highlight(paper, {});
  EXPECT_TRUE(report.finished);
  EXPECT_TRUE(std::isfinite(report.after.residual));
  EXPECT_NE(report.after.residual, report.before.residual);
  const net::ModelInfo made = net::read_model_info(report.weights);
  EXPECT_EQ(made.architecture, net::kMscrArchitecture);
  paper.folder = folder_ / "again";
  EXPECT_EQ(net::read_model_info(finetune_highlight(paper, {}).weights).sha256, made.sha256);
}

}  // namespace
}  // namespace faceprobe::train
