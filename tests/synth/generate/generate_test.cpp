#include "faceprobe/synth/generate.h"

#include "faceprobe/core/error.h"
#include "faceprobe/synth/person.h"
#include "support/temp_folder.h"
#include "synth/generate/small_world.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

namespace faceprobe::synth {
namespace {

std::map<std::string, std::string> bytes_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(in), {}};
  }
  return files;
}

TEST(Generate, TheBytesDoNotDependOnThreads) {
  const Assets assets = small_assets();
  const testing::TempFolder one;
  const testing::TempFolder two;
  generate_dataset(assets, small_recipe(), one.path(), {.threads = 1});
  generate_dataset(assets, small_recipe(), two.path(), {.threads = 2});
  EXPECT_EQ(bytes_of(one.path()), bytes_of(two.path()));
}

TEST(Generate, GoesOnWhereItStopped) {
  const Assets assets = small_assets();
  const testing::TempFolder whole;
  generate_dataset(assets, small_recipe(), whole.path(), {.threads = 1});
  const auto wanted = bytes_of(whole.path());

  const testing::TempFolder cut;
  struct Stop {};
  EXPECT_THROW(generate_dataset(assets, small_recipe(), cut.path(), {.threads = 1},
                                [](const RunState& state) {
                                  if (state.samples_done > 0) throw Stop{};
                                }),
               Stop);
  EXPECT_LT(bytes_of(cut.path()).size(), wanted.size());
  const DatasetReport report = generate_dataset(assets, small_recipe(), cut.path(), {.threads = 1});
  EXPECT_EQ(report.state.samples_found, 4);  // the first person's
  EXPECT_EQ(report.state.samples_done, 7);
  EXPECT_EQ(bytes_of(cut.path()), wanted);
}

TEST(Generate, AnotherRecipeIsRefusedAFolderThatIsTaken) {
  const Assets assets = small_assets();
  const testing::TempFolder folder;
  Recipe recipe = small_recipe();
  recipe.count = 2;
  recipe.views_per_person = 1;
  generate_dataset(assets, recipe, folder.path(), {.threads = 1});
  recipe.seed = 2;
  try {
    generate_dataset(assets, recipe, folder.path(), {.threads = 1});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kOutput);
    EXPECT_NE(std::string(error.what()).find("seed"), std::string::npos) << error.what();
  }
}

TEST(Generate, SplitsShareNobody) {
  const Assets assets = small_assets();
  Recipe recipe = small_recipe();
  recipe.split = Split::kTrain;
  const Person train = draw_person(assets, recipe, 0);
  recipe.split = Split::kDev;
  const Person dev = draw_person(assets, recipe, 0);
  EXPECT_GT((train.parameters.identity - dev.parameters.identity).norm(), 0.1F);
}

TEST(Generate, ShowsAFaceThatIsLitAndSharp) {
  const Assets assets = small_assets();
  const std::vector<ViewSamples> views = generate_person(assets, small_recipe(), 0);
  ASSERT_EQ(views.size(), 2U);
  for (const ViewSamples& view : views) {
    int skin = 0;
    for (const std::uint8_t region : view.view.region.values())
      skin += region >= 1 && region <= kSkinRegionCount ? 1 : 0;
    EXPECT_GT(skin, 48 * 48 / 8);  // the face fills a good part of the picture
    ASSERT_EQ(view.view.faces.size(), 1U);
    ASSERT_EQ(view.view.faces[0].landmarks_px.rows(), 68);
    // The middle of the features is where the camera aims, give or take the drawn offset (2.5 % of the picture, 4 deviations).
    EXPECT_NEAR(view.view.faces[0].landmarks_px.col(0).mean(), 24.0F, 7.0F);
    for (const Sample& sample : view.samples) {
      EXPECT_EQ(sample.photo.width(), 48);
      for (const float value : sample.highlight.values()) ASSERT_TRUE(std::isfinite(value) && value >= 0);
      for (const float value : sample.diffuse.values()) ASSERT_TRUE(std::isfinite(value) && value >= 0);
    }
  }
}

TEST(Generate, PaperModeHasOneSpecularAlbedoAndBlackBehind) {
  const Assets assets = small_assets();
  Recipe recipe = small_recipe();
  recipe.mode = Mode::kPaper;
  const Person person = draw_person(assets, recipe, 3);
  for (const SkinSettings& skin : person.skins) {
    for (const float rho : skin.specular_albedo) EXPECT_EQ(rho, skin.specular_albedo.front());
  }
  const std::vector<ViewSamples> views = generate_person(assets, recipe, 3);
  const ViewSamples& view = views.front();
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      if (view.view.depth_m(x, y) > 0) continue;
      EXPECT_EQ(view.samples.front().photo(x, y, 1), 0) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace faceprobe::synth
