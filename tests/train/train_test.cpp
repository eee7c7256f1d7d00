#include "faceprobe/train/train.h"

#include "faceprobe/core/error.h"
#include "train/small_data.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace faceprobe::train {
namespace {

TrainConfig tiny_config() {
  TrainConfig config;
  config.network = R"({"widths":[8,16]})";
  config.batch = 4;
  config.steps = 200;
  config.learning_rate = 5e-3;
  config.warm_up = 10;
  config.average_decay = 0.9;
  config.validate_every = 100;
  config.validation_samples = 8;
  config.save_every = 50;
  config.augment.occluder_share = 0;
  config.augment.no_mask_share = 0;
  return config;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Train, TwoHundredStepsLowerTheErrorAndAResumedRunIsTheSameBitForBit) {
  const DataFolder folder("resume", 32, 24);
  TrainRun run;
  run.config = tiny_config();
  run.data = run.validation_data = folder.data();
  run.folder = folder.run("whole");
  run.threads = 1;
  const TrainReport whole = train_highlight(run, {});
  ASSERT_TRUE(whole.finished);
  ASSERT_EQ(whole.rows.size(), 4U);
  ASSERT_TRUE(whole.rows.back().validated);
  // An empty layer is what a network that learnt nothing gives; the spots are easy.
  EXPECT_LT(whole.rows.back().validation.skin, 0.6 * whole.rows.back().validation.black_skin);
  EXPECT_LT(whole.rows.back().loss, 0.7 * whole.rows.front().loss);

  run.folder = folder.run("cut");
  int steps = 0;
  TrainHooks hooks;
  hooks.stop = [&] { return ++steps > 100; };
  EXPECT_FALSE(train_highlight(run, hooks).finished);
  const TrainReport resumed = train_highlight(run, {});
  EXPECT_TRUE(resumed.finished);
  ASSERT_EQ(resumed.rows.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(resumed.rows[i].loss, whole.rows[i].loss) << i;
  EXPECT_EQ(bytes_of(folder.run("cut") / "weights.safetensors"), bytes_of(folder.run("whole") / "weights.safetensors"));
}

// Short of the schedule's end, as shipped weights were: the rows say the rate of the whole schedule, and going on is as if it had not ended.
TEST(Train, ARunThatStopsAfterSomeStepsIsTheBeginningOfTheWhole) {
  const DataFolder folder("stop_after", 32, 8);
  TrainRun run;
  run.config = tiny_config();
  run.config.steps = 150;
  run.data = folder.data();
  run.threads = 1;
  run.folder = folder.run("whole");
  const TrainReport whole = train_highlight(run, {});
  run.folder = folder.run("part");
  run.stop_after = 100;
  std::int64_t told = 0;
  TrainHooks hooks;
  hooks.progress = [&](const TrainProgress& progress) { told = progress.steps; };
  const TrainReport part = train_highlight(run, hooks);
  EXPECT_TRUE(part.finished);
  EXPECT_EQ(told, 100);
  ASSERT_EQ(part.rows.size(), 2U);
  EXPECT_EQ(part.rows[1].loss, whole.rows[1].loss);
  EXPECT_EQ(part.rows[1].learning_rate, whole.rows[1].learning_rate);
  EXPECT_GT(part.rows[1].learning_rate, whole.rows[2].learning_rate);
  const std::string weights = bytes_of(part.weights);
  EXPECT_TRUE(train_highlight(run, {}).finished) << "nothing is left to do";
  EXPECT_EQ(bytes_of(part.weights), weights);
  EXPECT_NE(weights, bytes_of(whole.weights));
  run.stop_after = 50;
  EXPECT_THROW(train_highlight(run, {}), Error);
  run.stop_after = 151;
  EXPECT_THROW(train_highlight(run, {}), Error);
  run.stop_after = 0;
  train_highlight(run, {});
  EXPECT_EQ(bytes_of(part.weights), bytes_of(whole.weights));
}

TEST(Train, ARunOfAnotherConfigIsRefusedItsFolder) {
  const DataFolder folder("taken", 32, 8);
  TrainRun run;
  run.config = tiny_config();
  run.config.steps = 50;
  run.data = folder.data();
  run.folder = folder.run("run");
  run.threads = 1;
  train_highlight(run, {});
  run.config.learning_rate = 1e-4;
  try {
    train_highlight(run, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
  }
}

TEST(Train, TheFaceNetworkLearnsTheSurfaceBesideTheHighlights) {
  const DataFolder folder("face", 32, 24);
  TrainRun run;
  run.config = tiny_config();
  run.config.architecture = "face";
  run.data = run.validation_data = folder.data();
  run.folder = folder.run("run");
  run.threads = 1;
  const TrainReport report = train_highlight(run, {});
  ASSERT_TRUE(report.finished);
  const Validation& first = report.rows[1].validation;  // after 100 steps
  const Validation& last = report.rows.back().validation;
  EXPECT_LT(last.skin, last.black_skin);
  EXPECT_LT(last.normal_deg, 15);  // pointing at the camera everywhere is off by 25
  EXPECT_GT(last.region_share, 0.9);
  EXPECT_LT(last.colour_deg, 10);
  EXPECT_LE(last.normal_deg, first.normal_deg);
}

TEST(Train, ProductsInBf16AreForACard) {
  const DataFolder folder("bf16", 32, 8);
  TrainRun run;
  run.config = tiny_config();
  run.config.precision = "bf16";
  run.data = folder.data();
  run.folder = folder.run("run");
  try {
    train_highlight(run, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find("--device cuda"), std::string::npos) << error.what();
  }
}

TEST(Train, TheFaceNetworkNeedsMeshes) {
  const DataFolder folder("no_mesh", 32, 8);
  std::filesystem::remove(folder.data() / synth::mesh_name(0));
  TrainRun run;
  run.config = tiny_config();
  run.config.architecture = "face";
  run.data = folder.data();
  run.folder = folder.run("run");
  try {
    train_highlight(run, {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_NE(std::string(error.what()).find("faceprobe mesh"), std::string::npos) << error.what();
  }
}

TEST(Train, ThePapersNetworkTrainsToo) {
  const DataFolder folder("mscr", 32, 8);
  TrainRun run;
  run.config = tiny_config();
  run.config.architecture = "mscr";
  run.config.network = "{}";
  run.config.batch = 2;
  run.config.steps = 2;
  run.data = run.validation_data = folder.data();
  run.folder = folder.run("run");
  run.threads = 1;
  const TrainReport report = train_highlight(run, {});
  EXPECT_TRUE(report.finished);
  EXPECT_TRUE(std::isfinite(report.rows.back().loss));
  EXPECT_TRUE(std::filesystem::exists(report.weights));
}

TEST(TrainConfig, SaysWhatIsWrong) {
  const auto refused = [](const std::string& text, const std::string& words) {
    try {
      train_config_from_json(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused("[1]", "not a JSON object");
  refused(R"({"batches": 3})", "\"batches\"");
  refused(R"({"batch": "many"})", "batch");
  refused(R"({"batch": 0})", "is 0; allowed is 1 to 4096");
  refused(R"({"learning_rate": 2})", "1e-9 to 1");
  refused(R"({"architecture": "vgg"})", "unet, face, mscr, shi and albedo_shading");
  refused(R"({"precision": "half"})", "float32 and bf16");
  refused(R"({"architecture": "shi", "precision": "bf16"})", "bf16 for the others");
  refused(R"({"network": [8, 8]})", "[8,8] for network");
  const TrainConfig config = train_config_from_json(R"({"batch": 3, "network": {"widths": [8, 8]}})");
  EXPECT_EQ(config.batch, 3);
  EXPECT_EQ(to_json(train_config_from_json(to_json(config))), to_json(config));
}

TEST(TrainLog, HasALineForEachRowAndACurve) {
  std::vector<TrainRow> rows(3);
  for (std::size_t i = 0; i < 3; ++i)
    rows[i] = {static_cast<std::int64_t>(50 * (i + 1)), 0.1 / (1.0 + static_cast<double>(i)), 1e-3, 20, i == 2, {}};
  rows[2].validation = {4, 5, 8, 9};
  const std::string csv = to_csv(rows);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("150,0.0333333,0.001,20.00,4.0000,5.0000,8.0000,9.0000,0.000,0.0000,0.0000,0.000,0.0000\n"),
            std::string::npos)
      << csv;
  const ByteImage picture = draw_curves(rows);
  int dark = 0;
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) dark += picture.data()[3 * i] < 60 ? 1 : 0;
  EXPECT_GT(dark, 400);  // the loss goes from one side to the other
}

}  // namespace
}  // namespace faceprobe::train
