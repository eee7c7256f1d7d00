#include "faceprobe/train/finetune.h"

#include "faceprobe/core/color.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/net/model_file.h"
#include "net/torch/mscr.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"
#include "train/finetune_state.h"
#include "train/small_data.h"
#include "train/small_person.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

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

std::string whole_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
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
  // With everything that a run can have: synthetic faces to learn from and to measure on, scores in between, averaged weights.
  FinetuneRun full_run(const DataFolder& faces) const {
    FinetuneRun full = run(5);
    full.synthetic = full.validation = faces.data();
    full.config.synthetic_batch = 2;
    full.config.validation_samples = 4;
    full.config.steps = 24;
    full.config.score_every = 8;
    full.config.save_every = 5;
    full.config.ema = 0.9;
    full.config.max_validation_rise = 1000;
    return full;
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
  const FinetuneReport first = finetune_highlight(once, {});
  once.folder = folder_ / "again";
  EXPECT_EQ(whole_file(finetune_highlight(once, {}).weights), whole_file(first.weights));
}

// Killed between two checkpoints, and stopped: both end as the run that was left alone, in weights, scores and log.
TEST_F(FinetuneTest, AResumedRunIsTheSameBitForBit) {
  const DataFolder faces("finetune_resume", 32, 8);
  FinetuneRun whole = full_run(faces);
  whole.folder = folder_ / "whole";
  const FinetuneReport at_once = finetune_highlight(whole, {});
  ASSERT_TRUE(at_once.finished);
  ASSERT_EQ(at_once.scores.size(), 4U);  // of the start and of steps 8, 16 and 24
  EXPECT_NE(at_once.scores[1].residual, at_once.scores[2].residual);

  int asked = 0;
  FinetuneHooks killed;
  killed.stop = [&]() -> bool {
    if (++asked > 13) throw std::runtime_error("killed");
    return false;
  };
  FinetuneHooks stopped;
  stopped.stop = [&] { return ++asked > 12; };
  for (const FinetuneHooks* hooks : {&killed, &stopped}) {
    SCOPED_TRACE(hooks == &killed ? "killed" : "stopped");
    FinetuneRun cut = full_run(faces);
    cut.folder = folder_ / (hooks == &killed ? "killed" : "stopped");
    asked = 0;
    if (hooks == &killed) {
      EXPECT_THROW(finetune_highlight(cut, *hooks), std::runtime_error);
    } else {
      EXPECT_FALSE(finetune_highlight(cut, *hooks).finished);
    }
    std::int64_t begun = -1;  // the first step that is asked about again
    FinetuneHooks counting;
    std::int64_t steps = 0;
    counting.stop = [&] {
      ++steps;
      return false;
    };
    const FinetuneReport resumed = finetune_highlight(cut, counting);
    begun = cut.config.steps - steps;
    EXPECT_EQ(begun, hooks == &killed ? 10 : 12);  // the last multiple of save_every; the step it stopped at
    EXPECT_TRUE(resumed.finished);
    ASSERT_EQ(resumed.scores.size(), at_once.scores.size());
    for (std::size_t i = 0; i < at_once.scores.size(); ++i) {
      EXPECT_EQ(resumed.scores[i].residual, at_once.scores[i].residual) << i;
      EXPECT_EQ(resumed.scores[i].synthetic_rmse, at_once.scores[i].synthetic_rmse) << i;
    }
    for (const char* file : {"weights.safetensors", "log.csv", "scores.csv"})
      EXPECT_EQ(whole_file(cut.folder / file), whole_file(whole.folder / file)) << file;
  }
}

// What is done is not done again, and another config is not mixed with it.
TEST_F(FinetuneTest, AFolderBelongsToOneRun) {
  FinetuneRun once = run(4);
  once.config.steps = 3;
  const FinetuneReport first = finetune_highlight(once, {});
  int rows = 0;
  FinetuneHooks hooks;
  hooks.progress = [&](const FinetuneRow&, std::int64_t) { ++rows; };
  const FinetuneReport second = finetune_highlight(once, hooks);
  EXPECT_EQ(rows, 0);
  EXPECT_TRUE(second.finished);
  EXPECT_EQ(second.after.residual, first.after.residual);
  once.config.weight = 5;
  expect_error(ExitCode::kOutput, {"another config"}, [&] { finetune_highlight(once, {}); });
  once.config.weight = run(4).config.weight;
  once.people.pop_back();
  expect_error(ExitCode::kOutput, {"another config"}, [&] { finetune_highlight(once, {}); });
}

TEST_F(FinetuneTest, AStopIsObeyed) {
  int asked = 0;
  FinetuneHooks hooks;
  hooks.stop = [&] { return ++asked > 20; };
  const FinetuneReport report = finetune_highlight(run(4), hooks);
  EXPECT_FALSE(report.finished);
  EXPECT_EQ(report.rows.size(), 2U);
}

// The error on synthetic faces may not rise at all: what is kept is the last scored step that obeys, and the file says which.
TEST_F(FinetuneTest, TheWeightsOfTheChosenStepAreKept) {
  const DataFolder faces("finetune_choice", 32, 8);
  FinetuneRun strict = full_run(faces);
  strict.config.max_validation_rise = 0;
  const FinetuneReport report = finetune_highlight(strict, {});
  ASSERT_TRUE(report.validated);
  EXPECT_GT(report.before.synthetic_rmse, 0);
  EXPECT_LE(report.after.synthetic_rmse, report.before.synthetic_rmse);
  for (const FinetuneScore& score : report.scores) {
    if (score.step <= report.after.step) continue;
    EXPECT_GT(score.synthetic_rmse, report.before.synthetic_rmse) << score.step;
  }
  const std::map<std::string, std::string> metadata = net::read_model_info(report.weights).metadata;
  EXPECT_NE(metadata.at("finetune").find("\"step\": " + std::to_string(report.after.step) + ","), std::string::npos)
      << metadata.at("finetune");
}

// The averaged weights are what is scored: they lag behind the weights themselves, which the same run without an average has.
TEST_F(FinetuneTest, TheAverageIsWhatIsScored) {
  FinetuneRun averaged = run(5);
  averaged.config.steps = 20;
  averaged.config.ema = 0.999;
  const FinetuneReport mean = finetune_highlight(averaged, {});
  averaged.config.ema = 0;
  averaged.folder = folder_ / "plain";
  const FinetuneReport plain = finetune_highlight(averaged, {});
  EXPECT_EQ(mean.before.residual, plain.before.residual);
  ASSERT_EQ(mean.rows.size(), plain.rows.size());
  for (std::size_t i = 0; i < mean.rows.size(); ++i) EXPECT_EQ(mean.rows[i].residual, plain.rows[i].residual) << i;
  EXPECT_NE(mean.after.residual, plain.after.residual);
  EXPECT_NE(whole_file(mean.weights), whole_file(plain.weights));
}

TEST_F(FinetuneTest, PicturesShowPeopleWhoWereHeldOut) {
  std::map<std::string, ByteImage> pictures;
  FinetuneHooks hooks;
  hooks.write_picture = [&](const std::filesystem::path& path, const ByteImage& picture) {
    pictures[path.filename().string()] = picture;
  };
  const FinetuneRun six = run(6);
  const FinetuneReport report = finetune_highlight(six, hooks);
  ASSERT_TRUE(pictures.contains("people.png"));
  const ByteImage& sheet = pictures["people.png"];
  EXPECT_EQ(sheet.width(), 4 * testing::kCrop);
  EXPECT_EQ(sheet.height(), report.before.people * testing::kCrop);
  const auto cell = [&sheet](int column) {
    ByteImage out(testing::kCrop, testing::kCrop, 3);
    for (int y = 0; y < testing::kCrop; ++y)
      std::ranges::copy(sheet.row(y).subspan(static_cast<std::size_t>(3 * column * testing::kCrop), out.row(y).size()),
                        out.row(y).begin());
    return out;
  };
  EXPECT_TRUE(std::ranges::any_of(
      six.people, [&](const PersonSet& one) { return encode_srgb(one.photos.front()->linear) == cell(0); }));
  EXPECT_NE(cell(1), cell(2)) << "the layers before and after are the same";
  EXPECT_TRUE(pictures.contains("curves.png"));
  EXPECT_FALSE(pictures.contains("validation.png"));
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

TEST(FinetuneConfig, IsReadAsTheOthersAre) {
  const auto read = [](const std::string& text) { finetune_config_from_json(text); };
  expect_error(ExitCode::kUsage, {"finetuning config", "\"wieght\"", "energy_weight"},
               [&] { read(R"({"wieght": 3})"); });
  expect_error(ExitCode::kUsage, {"\"many\" for steps"}, [&] { read(R"({"steps": "many"})"); });
  expect_error(ExitCode::kUsage, {"ema is 1.0", "0 to 0.999999"}, [&] { read(R"({"ema": 1.0})"); });
  expect_error(ExitCode::kUsage, {"not a JSON object"}, [&] { read("[]"); });
  const FinetuneConfig config = finetune_config_from_json(R"({"steps": 7, "mode": "paper"})");
  EXPECT_EQ(config.steps, 7);
  EXPECT_EQ(config.photos, FinetuneConfig().photos);
  EXPECT_EQ(to_json(finetune_config_from_json(to_json(config))), to_json(config));
}

// The recipe that bench/people.sh measures.
TEST(FinetuneConfig, TheCommittedOneIsUsable) {
  const FinetuneConfig config =
      finetune_config_from_json(io::read_text(io::data_file("finetune.json"), std::int64_t{1} << 20));
  EXPECT_EQ(config.steps, 300);
  EXPECT_EQ(config.weight, 30);
  EXPECT_EQ(config.energy_weight, 0.1);
  EXPECT_EQ(config.synthetic_batch, 16);
}

FinetuneScore score_of(std::int64_t step, double synthetic_rmse) {
  return {
      .step = step, .people = 3, .residual = 0.06, .untouched = 0.07, .energy = 0.02, .synthetic_rmse = synthetic_rmse};
}

TEST(KeptScore, IsTheLastWithinTheLimit) {
  const std::vector<FinetuneScore> scores = {score_of(0, 5), score_of(50, 5.2), score_of(100, 5.3), score_of(150, 5.24),
                                             score_of(200, 5.6)};
  EXPECT_EQ(kept_score(scores, 0.05), 3U);  // to 5.25; the second is within as well, but before it
  EXPECT_EQ(kept_score(scores, 0.03), 0U);  // to 5.15: the start
  EXPECT_EQ(kept_score(scores, 0.12 + 1e-9), 4U);
  EXPECT_EQ(kept_score({score_of(0, 0), score_of(50, 0)}, 0.05), 1U) << "nothing was validated";
  EXPECT_EQ(kept_score({score_of(0, 5), score_of(50, std::nan(""))}, 0.05), 0U);
}

TEST(FinetuneTable, SaysStepsAndChanges) {
  FinetuneReport report;
  report.steps = 300;
  report.max_validation_rise = 0.05;
  report.validated = true;
  report.before = score_of(0, 5);
  report.after = score_of(250, 5.2);
  report.after.residual = 0.045;  // a quarter less
  report.after.energy = 0.021;
  const std::string table = finetune_table(report);
  EXPECT_NE(table.find("3 people held out; kept is step 250 of 300"), std::string::npos) << table;
  EXPECT_NE(table.find("at most 5 %"), std::string::npos) << table;
  EXPECT_NE(table.find("| before | 0 | 0.06000 | 0.07000 | 0.0200 | 5.00 |\n"), std::string::npos) << table;
  EXPECT_NE(table.find("| after | 250 | 0.04500 | 0.07000 | 0.0210 | 5.20 |\n"), std::string::npos) << table;
  EXPECT_NE(table.find("| change | | -25.0 % | | +5.0 % | +4.0 % |\n"), std::string::npos) << table;
  report.after = report.before;
  EXPECT_NE(finetune_table(report).find("kept is the start"), std::string::npos);
  report.validated = false;
  report.after = score_of(300, 0);
  EXPECT_EQ(finetune_table(report).find("synthetic"), std::string::npos) << finetune_table(report);
}

TEST(FinetuneState, ComesBackFromACheckpointAsItWas) {
  FinetuneState state;
  state.step = 13;
  state.rows = {{10, 1.0 / 3, 0.1, 0, 2e-9}};
  state.scores = {score_of(0, 5), score_of(8, 1.0 / 7)};
  state.sum = {0, 0.2, 0.3, 0.4, 0.5};
  state.people_steps = 2;
  FinetuneState back = from_checkpoint(to_checkpoint(state));
  EXPECT_EQ(back.step, 13);
  ASSERT_EQ(back.rows.size(), 1U);
  EXPECT_EQ(back.rows[0].residual, 1.0 / 3);
  EXPECT_EQ(to_csv(back.scores, 0.05), to_csv(state.scores, 0.05));
  add_row(back);
  EXPECT_EQ(back.rows[1].step, 13);
  EXPECT_EQ(back.rows[1].residual, 0.1);                   // of two steps
  EXPECT_DOUBLE_EQ(back.rows[1].synthetic_loss, 0.5 / 3);  // of the three since step 10
}

}  // namespace
}  // namespace faceprobe::train
