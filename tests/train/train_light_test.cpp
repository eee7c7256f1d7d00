#include "faceprobe/train/train_light.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/face_features.h"
#include "faceprobe/net/light_prior.h"
#include "faceprobe/synth/traced.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace faceprobe::train {
namespace {

// A matt ball under a lamp somewhere in front: its features, and that light.
synth::TracedPhoto ball_under_a_lamp(Random& random) {
  const SphereGrid grid(lighting::kFeatureNside);
  const Eigen::Vector3f towards =
      Eigen::Vector3d(random.between(-1, 1), random.between(-0.6, 0.8), 0.8).normalized().cast<float>();
  lighting::Observations ball;
  std::vector<Eigen::RowVector3f> normals;
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).z() > 0.2F) normals.push_back(grid.direction(j).transpose());
  }
  ball.resize(static_cast<Eigen::Index>(normals.size()));
  for (Eigen::Index i = 0; i < ball.count(); ++i) {
    ball.normal.row(i) = normals[static_cast<std::size_t>(i)];
    ball.view.row(i) = Eigen::RowVector3f(0, 0, 1);
    ball.shading.row(i).setConstant(0.1F + std::max(0.0F, ball.normal.row(i).dot(towards.transpose())));
  }
  synth::TracedPhoto photo{lighting::face_features(ball), Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F)};
  const auto lamp = static_cast<float>(3.14159265 / grid.cell_solid_angle());
  photo.light.row(grid.cell_of(towards)).array() += lamp;
  photo.light /= lighting::shading_level(ball);
  return photo;
}

struct TrainLightTest : public ::testing::Test {
  TrainLightTest() {
    for (const auto& [name, seed, count] : {std::tuple{"train", 1, 300}, {"dev", 2, 60}}) {
      std::filesystem::create_directory(folder_ / name);
      Random random({static_cast<std::uint64_t>(seed)});
      std::vector<synth::TracedPhoto> photos;
      for (int i = 0; i < count; ++i) photos.push_back(ball_under_a_lamp(random));
      synth::write_traced(folder_ / name, 0, std::span(photos).first(photos.size() / 2));
      synth::write_traced(folder_ / name, 1, std::span(photos).subspan(photos.size() / 2));
    }
    run_.config = {.hidden = {48}, .batch = 32, .epochs = 20, .learning_rate = 4e-3};
    run_.data = folder_ / "train";
    run_.validation_data = folder_ / "dev";
    run_.folder = folder_ / "run";
  }

  static std::string bytes(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  testing::TempFolder folder_;
  LightRun run_;
};

TEST_F(TrainLightTest, LearnsWhereTheLampIs) {
  const LightReport report = train_light(run_);
  ASSERT_EQ(report.rows.size(), 20U);
  EXPECT_LT(report.rows.back().validation.diffuse, 0.6 * report.rows.front().validation.diffuse);  // it learnt something
  // The brightest cell is on the lamp's side.
  const net::LightPrior prior(report.weights);
  const SphereGrid grid(lighting::kFeatureNside);
  int near = 0;
  Random random({9});
  for (int i = 0; i < 20; ++i) {
    const synth::TracedPhoto photo = ball_under_a_lamp(random);
    Eigen::Index found = 0;
    Eigen::Index truth = 0;
    prior.radiance(photo.features).col(1).maxCoeff(&found);
    photo.light.col(1).maxCoeff(&truth);
    near += grid.direction(static_cast<int>(found)).dot(grid.direction(static_cast<int>(truth))) > 0.8F ? 1 : 0;
  }
  EXPECT_GE(near, 14);  // of 20; by chance a cell within 37 degrees (cosine .8) would be 2
}

TEST_F(TrainLightTest, TheSameSeedGivesTheSameBytes) {
  run_.config.epochs = 2;
  const std::string once = bytes(train_light(run_).weights);
  run_.folder = folder_ / "again";
  EXPECT_EQ(bytes(train_light(run_).weights), once);
  run_.config.seed = 2;
  run_.folder = folder_ / "other";
  EXPECT_NE(bytes(train_light(run_).weights), once);
}

TEST_F(TrainLightTest, TwoFoldersAreAsOneWithBoth) {
  run_.config.epochs = 1;
  const std::string once = bytes(train_light(run_).weights);
  for (int shard = 0; shard < 2; ++shard) {
    const std::filesystem::path half = folder_ / ("half" + std::to_string(shard));
    std::filesystem::create_directory(half);
    std::filesystem::copy(folder_ / "train" / synth::traced_name(shard), half);
  }
  run_.data = folder_ / "half0";
  run_.more_data = {folder_ / "half1"};
  run_.folder = folder_ / "both";
  EXPECT_EQ(bytes(train_light(run_).weights), once);
}

TEST_F(TrainLightTest, DataThatWereNotReadAreASentence) {
  std::filesystem::create_directory(folder_ / "empty");
  run_.data = folder_ / "empty";
  try {
    train_light(run_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_NE(std::string(error.what()).find("faceprobe trace"), std::string::npos) << error.what();
  }
}

TEST(LightConfig, ComesBackFromItsText) {
  const LightConfig config{.hidden = {7, 9}, .epochs = 3, .drop = 0.5, .seed = 11};
  const LightConfig again = light_config_from_json(to_json(config));
  EXPECT_EQ(to_json(again), to_json(config));
  EXPECT_EQ(again.hidden, config.hidden);
}

TEST(LightConfig, RefusesWhatItDoesNotKnow) {
  for (const char* text : {"[]", R"({"epoch": 3})", R"({"epochs": "many"})", R"({"epochs": 0})", R"({"hidden": []})",
                           R"({"hidden": [0]})", R"({"drop": 1.0})", R"({"learning_rate": -1})"}) {
    EXPECT_THROW(light_config_from_json(text), Error) << text;
  }
}

}  // namespace
}  // namespace faceprobe::train
