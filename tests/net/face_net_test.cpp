#include "faceprobe/net/face_net.h"

#include "faceprobe/core/mirror.h"
#include "faceprobe/core/region.h"
#include "net/face_layers.h"
#include "net/face_outputs.h"
#include "net/fixtures.h"
#include "net/padded_picture.h"
#include "net/torch/face_head.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

struct FaceNetTest : public ::testing::Test {
  FaceNetTest() {
    options.in_channels = FaceInputs::kCount;
    options.out_channels = FaceOutputs::kCount;
    std::map<std::string, std::string> metadata = testing::unet_metadata(options);
    metadata[kArchitectureKey] = kFaceArchitecture;
    torch::manual_seed(1);
    UNet net(options);
    {
      // As drawn, the outputs hardly depend on the picture.
      const torch::NoGradGuard no_grad;
      net->named_parameters()["head.weight"].mul_(5);
    }
    save_weights(*net, path(), metadata, false);
  }
  std::filesystem::path path() const { return folder_ / "face.safetensors"; }

  testing::TempFolder folder_;
  UNetOptions options = testing::small_options();
};

TEST_F(FaceNetTest, SaysWhatTheTrainingSays) {
  UNet net(options);
  load_weights(*net, path());
  PaddedPicture picture = pad_picture(random_picture(16, 8, 0, 1), {}, {}, 8);
  const torch::NoGradGuard no_grad;
  // Its values have no meaning here, only their place.
  Image mesh = random_picture(16, 8, -1, 1);
  const FaceInput input = prepare_face_input(tensor_view(picture.linear), tensor_view(picture.clip),
                                             tensor_view(picture.mask), tensor_view(mesh));
  const FaceSurface expected = surface_from_raw(split_face_raw(net(input.channels)).surface, input.gain);
  const torch::Tensor shading = expected.log_level.exp() * expected.colour;
  const torch::Tensor open = expected.open_log_level.exp() * expected.open_colour;
  const torch::Tensor region = expected.region.argmax(1);
  const FaceLayers layers = FaceNet(path(), {.threads = 1}).layers(picture.linear, {}, {}, mesh);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) {
        // Single precision through two dozen layers, summed in another order.
        EXPECT_NEAR(layers.normal_cam(x, y, c), expected.normal[0][c][y][x].item<float>(), 1e-4F);
        const float light = shading[0][c][y][x].item<float>();
        EXPECT_NEAR(layers.shading(x, y, c), light, 1e-4F * (1 + light));
        const float ball = open[0][c][y][x].item<float>();
        EXPECT_NEAR(layers.open_shading(x, y, c), ball, 1e-4F * (1 + ball));
      }
      const float spread = expected.spread[0][0][y][x].item<float>();
      EXPECT_NEAR(layers.normal_error_rad(x, y), spread, 1e-4F * (1 + spread));
      EXPECT_NEAR(layers.depth_m(x, y), FaceOutputs::kDepthUnit * expected.depth[0][0][y][x].item<float>(), 1e-4F);
      EXPECT_EQ(layers.region(x, y), region[0][y][x].item<std::int64_t>());
    }
  }
}

// As trained before there was an open shading.
TEST_F(FaceNetTest, WeightsWithoutAnOpenShadingHaveTheRest) {
  UNetOptions before = options;
  before.out_channels = FaceOutputs::kCountWithoutOpen;
  std::map<std::string, std::string> metadata = testing::unet_metadata(before);
  metadata[kArchitectureKey] = kFaceArchitecture;
  UNet net(before);
  save_weights(*net, path(), metadata, false);
  const FaceNet network(path(), {.threads = 1});
  const FaceLayers layers = network.layers_both_ways(random_picture(16, 8, 0, 1), {}, {}, {});
  EXPECT_TRUE(layers.open_shading.empty());
  EXPECT_EQ(layers.shading.width(), 16);
  const FaceSurface surface = surface_from_raw(
      split_face_raw(torch::zeros({1, FaceOutputs::kCountWithoutOpen, 8, 8})).surface, torch::ones({1, 1, 1, 1}));
  EXPECT_FALSE(surface.open_log_level.defined());
}

// A picture as bright again is the same picture to it.
TEST_F(FaceNetTest, HalfTheLightGivesHalfOfEveryLayer) {
  const FaceNet net(path(), {.threads = 1});
  const Image picture = random_picture(24, 16, 0.01F, 1);
  Image half = picture;
  for (float& light : half.values()) light *= 0.5F;
  const FaceLayers full = net.layers(picture, {}, {}, {});
  const FaceLayers dimmed = net.layers(half, {}, {}, {});
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    EXPECT_NEAR(2 * dimmed.highlight.data()[i], full.highlight.data()[i], 1e-4F);
    EXPECT_NEAR(2 * dimmed.shading.data()[i], full.shading.data()[i], 1e-4F * (1 + full.shading.data()[i]));
    EXPECT_NEAR(dimmed.normal_cam.data()[i], full.normal_cam.data()[i], 1e-4F);
  }
}

TEST_F(FaceNetTest, AMirroredPhotoHasTheMirroredLayers) {
  const FaceNet net(path(), {.threads = 1});
  const Image picture = random_picture(24, 16, 0, 1);
  const Image mesh = random_picture(24, 16, -1, 1);
  const FaceLayers layers = net.layers_both_ways(picture, {}, {}, mesh);
  const FaceLayers other = net.layers_both_ways(mirrored(picture), {}, {}, mirrored_normals(mesh));
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      // The two looks are averaged in another order; the shading is of the order of 10.
      EXPECT_NEAR(other.normal_cam(23 - x, y, 0), -layers.normal_cam(x, y, 0), 1e-6F);
      EXPECT_NEAR(other.normal_cam(23 - x, y, 1), layers.normal_cam(x, y, 1), 1e-6F);
      EXPECT_NEAR(other.shading(23 - x, y, 1), layers.shading(x, y, 1), 1e-5F);
      EXPECT_NEAR(other.open_shading(23 - x, y, 1), layers.open_shading(x, y, 1), 1e-5F);
      EXPECT_NEAR(other.highlight(23 - x, y, 2), layers.highlight(x, y, 2), 1e-6F);
    }
  }
}

TEST_F(FaceNetTest, HostilePicturesGiveLayersThatCanBeUsed) {
  Image picture = random_picture(40, 24, -0.5F, 2);
  picture(3, 4, 0) = std::numeric_limits<float>::quiet_NaN();
  picture(30, 20, 2) = std::numeric_limits<float>::infinity();
  picture(8, 9, 1) = std::numeric_limits<float>::max();
  const FaceLayers layers = FaceNet(path(), {.threads = 1}).layers(picture, ByteImage(40, 24, 1, 7), {}, {});
  for (std::size_t i = 0; i < layers.region.values().size(); ++i) {
    const float* n = layers.normal_cam.data() + 3 * i;
    ASSERT_NEAR(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1, 1e-4F) << i;
    ASSERT_GT(layers.normal_error_rad.data()[i], 0);
    ASSERT_LT(layers.region.data()[i], kRegionCount);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_TRUE(std::isfinite(layers.shading.data()[3 * i + c]));
      ASSERT_GT(layers.shading.data()[3 * i + c], 0);
    }
  }
  EXPECT_TRUE(FaceNet(path()).layers(Image(0, 5, 3), {}, {}, {}).normal_cam.empty());
}

TEST_F(FaceNetTest, AGreyPhotoHasGreyShading) {
  Image picture = random_picture(16, 16, 0, 1);
  for (std::size_t i = 0; i < picture.values().size(); i += 3) std::fill_n(picture.data() + i, 3, picture.data()[i]);
  const FaceLayers layers = FaceNet(path()).layers_both_ways(picture, {}, {}, {});
  for (std::size_t i = 0; i < layers.shading.values().size(); i += 3) {
    EXPECT_EQ(layers.shading.data()[i], layers.shading.data()[i + 1]);
    EXPECT_EQ(layers.shading.data()[i], layers.shading.data()[i + 2]);
    EXPECT_EQ(layers.open_shading.data()[i], layers.open_shading.data()[i + 1]);
  }
}

TEST_F(FaceNetTest, SameForAnyNumberOfThreads) {
  const Image picture = random_picture(64, 48, 0, 1);
  const FaceLayers one = FaceNet(path(), {.threads = 1}).layers(picture, {}, {}, {});
  const FaceLayers two = FaceNet(path(), {.threads = 2}).layers(picture, {}, {}, {});
  EXPECT_EQ(one.normal_cam, two.normal_cam);
  EXPECT_EQ(one.shading, two.shading);
}

TEST_F(FaceNetTest, RefusesAnotherNetwork) {
  const std::filesystem::path other = folder_ / "unet.safetensors";
  testing::write_unet(other, testing::small_options());
  expect_error(ExitCode::kModel, {"unet", "face"}, [&] { FaceNet{other}; });
  expect_error(ExitCode::kUsage, {"threads"}, [&] { FaceNet(path(), {.threads = -1}); });
}

}  // namespace
}  // namespace faceprobe::net
