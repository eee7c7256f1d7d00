#include "faceprobe/net/light_regressor.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/net/face_window.h"
#include "net/fixtures.h"
#include "net/torch/light_cnn.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/weights.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using testing::expect_error;

const LightCnnOptions kSmallCnn{.picture_px = 16, .widths = {8, 16}, .features = 12, .light_size = 8};

std::int64_t numbers_in(const torch::nn::Module& module) {
  std::int64_t count = 0;
  for (const torch::Tensor& tensor : module.parameters()) count += tensor.numel();
  return count;
}

// Weights zero, so that what is usual is said of every picture.
void zero_weights(torch::nn::Module& module, const std::string& layer) {
  const torch::NoGradGuard no_grad;
  module.named_parameters()[layer + ".weight"].zero_();
}

class LightRegressorTest : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }

  template <class Net>
  LightRegressor saved(Net& net, const char* architecture) const {
    save_weights(*net, path(), {{kArchitectureKey, architecture}, {kOptionsKey, options_json(net->options())}}, false);
    return LightRegressor(path());
  }

  testing::TempFolder folder_;
};

TEST(LightCnn, IsSmall) {
  for (const std::int64_t count :
       {numbers_in(*GardnerNet(LightCnnOptions{})), numbers_in(*LegendreNet(LightCnnOptions{.light_size = 8}))}) {
    EXPECT_GT(count, 300'000);
    EXPECT_LT(count, 1'000'000);
  }
}

TEST(LightCnn, APanoramaIsItsLight) {
  torch::manual_seed(3);
  const torch::Tensor light = (6 * torch::rand({2, 3, 8, 16}) - 3).exp();  // 0.05 to 20
  const Panorama panorama = panorama_of(light);
  EXPECT_LE(panorama.colour.max().item<float>(), 1);
  EXPECT_GT((panorama.lights > 0).sum().item<std::int64_t>(), 0);
  EXPECT_LT((panorama_radiance(panorama) / light - 1).abs().max().item<float>(), 1e-4F);  // single precision, of powers
}

// What is at the left edge of a panorama lies beside its right edge: turned features would be a turned panorama.
TEST(LightCnn, APanoramaGoesOnBeyondItsSides) {
  torch::manual_seed(4);
  const LightCnnOptions options;
  PanoramaDecoder decoder(options, 1);
  const torch::NoGradGuard no_grad;
  // A start whose columns are all alike has nothing that could tell the edges from the middle.
  torch::Tensor weight = decoder->named_parameters()["start.weight"];
  torch::Tensor bias = decoder->named_parameters()["start.bias"];
  const std::int64_t rows = options.light_size / 8;
  weight.zero_();
  bias.copy_(torch::randn({32, rows, 1}).expand({32, rows, 2 * rows}).reshape({-1}));
  const torch::Tensor out = decoder->forward(torch::zeros({1, options.features}));
  EXPECT_LT((out - out.narrow(3, 5, 1)).abs().max().item<float>(), 1e-5F);  // single precision
  EXPECT_GT((out - out.narrow(2, 3, 1)).abs().max().item<float>(), 1e-3F);  // up and down differ
}

TEST_F(LightRegressorTest, LegendreSaysWhatItsCellsAre) {
  torch::manual_seed(1);
  LegendreNet net(kSmallCnn);
  const SphereGrid grid(kSmallCnn.light_size);
  torch::Tensor light = torch::full({grid.cell_count(), 3}, 0.5F);
  light.select(1, 2).fill_(2);
  const Eigen::Vector3f towards = Eigen::Vector3f(0.7F, 0.4F, -0.3F).normalized();
  light[grid.cell_of(towards)].fill_(90);
  net->start_at(light.log());
  zero_weights(*net, "light");
  const LightRegressor regressor = saved(net, kLegendreArchitecture);
  EXPECT_EQ(regressor.picture_px(), 16);
  EXPECT_EQ(regressor.info().architecture, "legendre");

  const Eigen::MatrixX3f found = regressor.light(testing::random_picture(40, 40, 0, 1));
  const SphereGrid fine(LightRegressor::kNside);
  ASSERT_EQ(found.rows(), fine.cell_count());
  Eigen::Index brightest = 0;
  found.col(1).maxCoeff(&brightest);
  EXPECT_GT(fine.direction(static_cast<int>(brightest)).dot(towards), 0.98F);  // a coarse cell is 7 degrees wide
  const Eigen::Index away = fine.cell_of(-towards);
  EXPECT_NEAR(found(away, 0), 0.5, 1e-4);
  EXPECT_NEAR(found(away, 2), 2, 1e-3);
}

TEST_F(LightRegressorTest, GardnerSaysWhatItsPanoramaIs) {
  torch::manual_seed(1);
  GardnerNet net(LightCnnOptions{.picture_px = 16, .widths = {8, 16}, .features = 12, .light_size = 16});
  torch::Tensor colour = torch::full({3, 16, 32}, 0.5F);
  torch::Tensor lights = torch::zeros({1, 16, 32});
  lights[0][4][8] = 4;  // right of the camera, above: u = .27, v = .28
  net->start_at({colour, lights});
  net->set_scale(1.5);
  for (const char* layer : {"colour.last", "lights.last"}) zero_weights(*net, layer);
  const LightRegressor regressor = saved(net, kGardnerArchitecture);
  const Eigen::MatrixX3f found = regressor.light(testing::random_picture(16, 16, 0, 1));
  const SphereGrid fine(LightRegressor::kNside);
  ASSERT_EQ(found.rows(), fine.cell_count());
  const Eigen::Vector3f towards = direction_from_uv({8.5F / 32, 4.5F / 16});
  EXPECT_GT(towards.x(), 0.5F);
  Eigen::Index brightest = 0;
  const float most = found.col(1).maxCoeff(&brightest);
  EXPECT_GT(fine.direction(static_cast<int>(brightest)).dot(towards), 0.98F);  // a texel is 11 degrees wide
  const float wall = std::pow(0.5F, LightCnnOptions::kGamma);
  EXPECT_NEAR(found(fine.cell_of(-towards), 1), wall, 0.1F * wall);  // cells share texels to a few percent
  EXPECT_NEAR(most / wall, std::exp(1.5F * 4), 0.1F * std::exp(1.5F * 4));
}

TEST_F(LightRegressorTest, ComesBackFromItsFile) {
  torch::manual_seed(5);
  LegendreNet net(kSmallCnn);
  net->eval();
  const LightRegressor regressor = saved(net, kLegendreArchitecture);
  Image picture = testing::random_picture(16, 16, 0, 1.2F);  // what is above white is clipped
  const Eigen::MatrixX3f found = regressor.light(picture);
  const LightRegressor moved = LightRegressor(path());
  EXPECT_EQ(moved.light(picture), found);

  for (float& value : picture.values()) value = srgb_from_linear(std::min(value, 1.0F));
  const torch::NoGradGuard no_grad;
  const torch::Tensor own = net->forward(tensor_view(picture)).exp();
  const SphereGrid grid(kSmallCnn.light_size);
  const torch::Tensor plain = own.reshape({-1, 3}).contiguous();
  const Eigen::MatrixX3f cells = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(
      plain.data_ptr<float>(), plain.size(0), 3);
  const Eigen::MatrixX3f wanted = grid_from_grid(cells, grid, SphereGrid(LightRegressor::kNside));
  EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), 1e-4F);  // single precision
  // And the picture matters.
  EXPECT_GT((regressor.light(testing::random_picture(16, 16, 0, 0.1F)) - found).cwiseAbs().maxCoeff(), 1e-3F);
}

TEST_F(LightRegressorTest, TakesSquaresOfAnySize) {
  torch::manual_seed(6);
  LegendreNet net(kSmallCnn);
  const LightRegressor regressor = saved(net, kLegendreArchitecture);
  const Image small = testing::random_picture(16, 16, 0, 1);
  Image large(48, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x)
      for (int c = 0; c < 3; ++c) large(x, y, c) = small(x / 3, y / 3, c);
  }
  EXPECT_LT((regressor.light(large) - regressor.light(small)).cwiseAbs().maxCoeff(),
            0.01F);  // means of nine equal pixels
}

TEST_F(LightRegressorTest, RefusesWhatIsNoCrop) {
  LegendreNet net(kSmallCnn);
  const LightRegressor regressor = saved(net, kLegendreArchitecture);
  EXPECT_THROW(regressor.light(Image()), std::invalid_argument);
  EXPECT_THROW(regressor.light(Image(16, 15, 3)), std::invalid_argument);
  EXPECT_THROW(regressor.light(Image(16, 16, 1)), std::invalid_argument);
}

TEST_F(LightRegressorTest, RefusesFilesThatAreNotItsOwn) {
  expect_error(ExitCode::kModel, {}, [&] { LightRegressor(folder_ / "none.safetensors"); });
  LegendreNet net(kSmallCnn);
  const auto write = [&](const std::string& architecture, const LightCnnOptions& options) {
    save_weights(*net, path(), {{kArchitectureKey, architecture}, {kOptionsKey, options_json(options)}}, false);
  };
  write("unet", kSmallCnn);
  expect_error(ExitCode::kModel, {"unet", "legendre"}, [&] { LightRegressor{path()}; });
  write(kGardnerArchitecture, kSmallCnn);  // of the other network
  expect_error(ExitCode::kModel, {}, [&] { LightRegressor{path()}; });
  LightCnnOptions other = kSmallCnn;
  other.features = 13;
  write(kLegendreArchitecture, other);
  expect_error(ExitCode::kModel, {}, [&] { LightRegressor{path()}; });
  other = kSmallCnn;
  other.widths = {9};
  write(kLegendreArchitecture, other);
  expect_error(ExitCode::kModel, {"widths"}, [&] { LightRegressor{path()}; });
  other = kSmallCnn;
  other.light_size = 12;  // a panorama doubles three times
  write(kGardnerArchitecture, other);
  expect_error(ExitCode::kModel, {"light_size"}, [&] { LightRegressor{path()}; });
}

TEST(FaceWindow, IsASquareAroundTheMask) {
  ByteImage mask(40, 60, 1);
  for (int y = 10; y < 50; ++y) {
    for (int x = 12; x < 32; ++x) mask(x, y) = 7;
  }
  const std::optional<Window> window = face_window(mask, 26);
  ASSERT_TRUE(window);
  EXPECT_EQ(window->width, 26);
  EXPECT_EQ(window->height, 26);
  EXPECT_NEAR(26 / window->scale, 1.3 * 40, 1e-9);  // the longer side and its margin
  EXPECT_NEAR(window->left_px + 13 / window->scale, 22, 1e-9);
  EXPECT_NEAR(window->top_px + 13 / window->scale, 30, 1e-9);
  EXPECT_FALSE(face_window(ByteImage(8, 8, 1), 26));
}

}  // namespace
}  // namespace faceprobe::net
