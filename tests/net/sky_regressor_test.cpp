#include "faceprobe/net/sky_regressor.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/sun_bins.h"
#include "net/fixtures.h"
#include "net/torch/sky_cnn.h"
#include "net/torch/weights.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;

const SkyCnnOptions kSmallSky{.px = 32, .widths = {4, 4, 6, 6, 8, 8, 8}, .hidden = 12};

struct SkyRegressorTest : public ::testing::Test {
  // Of an untrained network that has seen a few batches, so that what it knows of them differs from the start.
  SkyCnn write(const std::string& architecture = kSkyArchitecture, const SkyCnnOptions& said = kSmallSky) {
    torch::manual_seed(5);
    SkyCnn net(kSmallSky);
    const torch::Tensor usual = torch::tensor({3.0F, -3.0F, 0.1F, 1.1F, 1.0F});
    net->standardise(usual + 0.3 * torch::randn({50, kSkyNumbers}), 0.25);
    net->train();
    const torch::NoGradGuard no_grad;
    for (int i = 0; i < 5; ++i) net->forward(torch::rand({8, 3, 32, 32}));
    net->eval();
    save_weights(*net, path(), {{kArchitectureKey, architecture}, {kOptionsKey, options_json(said)}}, false);
    return net;
  }
  std::filesystem::path path() const { return folder_ / "sky.safetensors"; }

  testing::TempFolder folder_;
};

TEST_F(SkyRegressorTest, SaysWhatTheTrainingSays) {
  SkyCnn net = write();
  const SkyRegressor network(path());
  EXPECT_EQ(network.info().architecture, kSkyArchitecture);
  const Image crop = decode_srgb(encode_srgb(testing::random_picture(32, 32, 0, 1)));
  torch::Tensor pixels = torch::empty({1, 3, 32, 32});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int c = 0; c < 3; ++c) pixels[0][c][y][x] = srgb_from_linear(crop(x, y, c));
    }
  }
  const torch::NoGradGuard no_grad;
  const SkyCnnImpl::Output out = net->forward(pixels);
  const torch::Tensor share = out.sun.softmax(1);
  const torch::Tensor numbers = net->restored(out.numbers)[0];
  const SkyEstimate found = network.estimate(crop);
  ASSERT_EQ(found.sun_share.size(), kSunBins);
  EXPECT_NEAR(found.sun_share.sum(), 1, 1e-5);  // single precision
  for (int bin = 0; bin < kSunBins; ++bin) EXPECT_NEAR(found.sun_share[bin], share[0][bin].item<float>(), 1e-5F);
  const auto number = [&](SkyNumber which) { return numbers[static_cast<int>(which)].item<double>(); };
  // Single precision through convolutions that sum in another order; the numbers are of the order of 10.
  EXPECT_NEAR(found.sky.turbidity, number(SkyNumber::kTurbidity), 1e-4);
  EXPECT_NEAR(std::log(found.sky.exposure), number(SkyNumber::kLogExposure), 1e-4);
  EXPECT_NEAR(found.camera_elevation_rad, number(SkyNumber::kCameraElevation), 1e-4);
  EXPECT_NEAR(found.field_of_view_rad, number(SkyNumber::kFieldOfView), 1e-4);
  const Eigen::Vector3d sunlight = sun_irradiance(found.sky);
  EXPECT_NEAR(std::log(kLeastSunlight + sunlight.dot(luminance_weights<double>())), number(SkyNumber::kLogSunlight),
              1e-4);
  EXPECT_NEAR(found.sky.ground_albedo, 0.25, 1e-6);
  EXPECT_EQ(found.sky.validate(), "");
}

TEST_F(SkyRegressorTest, TheLightIsTheSkyInTheCamerasFrame) {
  write();
  const SkyRegressor network(path());
  const Image crop = testing::random_picture(40, 40, 0, 1);  // of another size than the network's
  const SkyEstimate found = network.estimate(crop);
  const Eigen::MatrixX3f light = network.light(crop);
  const SphereGrid grid(SkyRegressor::kLightNside);
  ASSERT_EQ(light.rows(), grid.cell_count());
  EXPECT_TRUE(light.allFinite());
  EXPECT_GE(light.minCoeff(), 0);
  EXPECT_EQ(light, sky_radiance(found.sky, grid, level_from_camera(found.camera_elevation_rad)));
  // Where the camera looks up, what is straight ahead in the picture is up in the world.
  const Eigen::Vector3f ahead = level_from_camera(radians(20)) * Eigen::Vector3f(0, 0, -1);
  EXPECT_NEAR(elevation_deg(ahead.cast<double>()), 20, 1e-3);
  EXPECT_NEAR(std::abs(azimuth_deg(ahead.cast<double>())), 180, 1e-3);
}

TEST_F(SkyRegressorTest, AnswersWithinTheModelWhateverThePicture) {
  write();
  const SkyRegressor network(path());
  for (const float value : {0.0F, 1.0F, 1e6F, -3.0F}) {
    const SkyEstimate found = network.estimate(Image(32, 32, 3, value));
    EXPECT_EQ(found.sky.validate(), "") << value;
    EXPECT_TRUE(network.light(Image(32, 32, 3, value)).allFinite());
  }
}

TEST_F(SkyRegressorTest, RefusesPicturesThatAreNone) {
  write();
  const SkyRegressor network(path());
  EXPECT_THROW(network.light(Image(32, 32, 1)), std::invalid_argument);
  EXPECT_THROW(network.light(Image(32, 30, 3)), std::invalid_argument);
  EXPECT_THROW(network.light(Image(0, 0, 3)), std::invalid_argument);
  EXPECT_THROW(network.light(Image(32, 32, 3, std::numeric_limits<float>::quiet_NaN())), std::invalid_argument);
}

TEST_F(SkyRegressorTest, RefusesOtherNetworksAndOptionsThatDoNotFit) {
  write("unet");
  expect_error(ExitCode::kModel, {"unet", "sky"}, [&] { SkyRegressor{path()}; });
  SkyCnnOptions other = kSmallSky;
  other.hidden = 13;
  write(kSkyArchitecture, other);
  expect_error(ExitCode::kModel, {"all"}, [&] { SkyRegressor{path()}; });
  other = kSmallSky;
  other.px = 33;
  write(kSkyArchitecture, other);
  expect_error(ExitCode::kModel, {"multiple of 32"}, [&] { SkyRegressor{path()}; });
  expect_error(ExitCode::kModel, {}, [&] { SkyRegressor{folder_ / "absent.safetensors"}; });
}

TEST(SkyCnn, IsAsSmallAsItSays) {
  const SkyCnn net{SkyCnnOptions{}};
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : net->parameters()) count += parameter.numel();
  EXPECT_GT(count, 300'000);
  EXPECT_LT(count, 800'000);
  for (const SkyCnnOptions& wrong :
       {SkyCnnOptions{.px = 100}, SkyCnnOptions{.widths = {1, 2}}, SkyCnnOptions{.hidden = 0}})
    EXPECT_THROW(SkyCnn{wrong}, std::invalid_argument);
}

TEST(SunOfShares, FindsAPlaceBetweenBins) {
  for (int bin = 0; bin < kSunBins; ++bin) {
    Eigen::VectorXf share = Eigen::VectorXf::Zero(kSunBins);
    share[bin] = 1;
    EXPECT_LT(angle_between_deg(sun_of_shares(share), sun_bin_direction(bin)), 1e-6) << bin;
  }
  // Two neighbours across the seam behind the camera share the sun between them.
  Eigen::VectorXf share = Eigen::VectorXf::Zero(kSunBins);
  share[kSunAzimuths] = 0.4F;
  share[2 * kSunAzimuths - 1] = 0.4F;
  share[kSunBins - 1] = 0.2F;  // far off: does not count
  const Eigen::Vector3d between = sun_of_shares(share);
  EXPECT_NEAR(std::abs(azimuth_deg(between)), 180, 1e-6);
  EXPECT_NEAR(elevation_deg(between), elevation_deg(sun_bin_direction(kSunAzimuths)), 0.3);  // a chord's middle is higher
  EXPECT_THROW(sun_of_shares(Eigen::VectorXf::Ones(10)), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::net
