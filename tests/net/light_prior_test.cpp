#include "faceprobe/net/light_prior.h"

#include "faceprobe/core/error.h"
#include "net/fixtures.h"
#include "net/torch/light_mlp.h"
#include "net/torch/weights.h"

#include <cmath>

namespace faceprobe::net {
namespace {

using testing::expect_error;

const LightOptions kSmall{.inputs = 7, .hidden = {5, 6}, .outputs = 12};

struct LightPriorTest : public ::testing::Test {
  LightMlp write(const std::string& architecture = kLightArchitecture, LightOptions said = kSmall) {
    torch::manual_seed(3);
    LightMlp net(kSmall);
    net->standardise(torch::randn({20, 7}) * 2 + 1);
    save_weights(*net, path(), {{kArchitectureKey, architecture}, {kOptionsKey, options_json(said)}}, false);
    return net;
  }
  std::filesystem::path path() const { return folder_ / "light.safetensors"; }

  testing::TempFolder folder_;
};

TEST_F(LightPriorTest, SaysWhatTheTrainingSays) {
  LightMlp net = write();
  const LightPrior prior(path());
  EXPECT_EQ(prior.inputs(), 7);
  const Eigen::VectorXf features = Eigen::VectorXf::LinSpaced(7, -2, 3);
  const torch::NoGradGuard no_grad;
  net->eval();
  torch::Tensor input = torch::from_blob(const_cast<float*>(features.data()), {1, 7}).clone();
  const torch::Tensor expected = net(input).exp();
  const Eigen::MatrixX3f light = prior.radiance(features);
  ASSERT_EQ(light.rows(), 4);
  for (int j = 0; j < 4; ++j) {
    for (int c = 0; c < 3; ++c) {
      const float value = expected[0][3 * j + c].item<float>();
      EXPECT_NEAR(light(j, c), value, 1e-4F * value);  // another order of sums
    }
  }
}

TEST_F(LightPriorTest, IsPositiveAndFiniteWhateverTheFeatures) {
  write();
  const LightPrior prior(path());
  for (const float size : {0.0F, 1e6F, -1e20F}) {
    const Eigen::MatrixX3f light = prior.radiance(Eigen::VectorXf::Constant(7, size));
    EXPECT_TRUE(light.allFinite());
    EXPECT_GT(light.minCoeff(), 0);
  }
  EXPECT_THROW(prior.radiance(Eigen::VectorXf::Zero(6)), std::invalid_argument);
}

TEST_F(LightPriorTest, RefusesOtherNetworksAndOptionsThatDoNotFit) {
  write("unet");
  expect_error(ExitCode::kModel, {"unet", "light"}, [&] { LightPrior{path()}; });
  write(kLightArchitecture, {.inputs = 8, .hidden = {5, 6}, .outputs = 12});
  expect_error(ExitCode::kModel, {"mean"}, [&] { LightPrior{path()}; });
  write(kLightArchitecture, {.inputs = 7, .hidden = {5, 6}, .outputs = 13});
  expect_error(ExitCode::kModel, {"multiple of 3"}, [&] { LightPrior{path()}; });
  expect_error(ExitCode::kModel, {}, [&] { LightPrior{folder_ / "absent.safetensors"}; });
}

}  // namespace
}  // namespace faceprobe::net
