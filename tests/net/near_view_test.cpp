#include "faceprobe/core/error.h"
#include "faceprobe/net/face_net.h"

#include "net/close_view.h"
#include "net/face_outputs.h"
#include "net/fixtures.h"
#include "net/torch/weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::net {
namespace {

using testing::expect_error;
using testing::random_picture;

constexpr int kPicturePx = 32;

struct NearViewTest : public ::testing::Test {
  std::filesystem::path weights(const std::string& picture_px) const {
    UNetOptions options = testing::small_options();
    options.in_channels = FaceInputs::kCount;
    options.out_channels = FaceOutputs::kCount;
    std::map<std::string, std::string> metadata = testing::unet_metadata(options);
    metadata[kArchitectureKey] = kFaceArchitecture;
    if (!picture_px.empty()) metadata[kPictureKey] = picture_px;
    torch::manual_seed(1);
    const std::filesystem::path path = folder_ / ("face" + picture_px + ".safetensors");
    save_weights(*UNet(options), path, metadata, false);
    return path;
  }

  // A face mask at some place of a picture of 60 x 48.
  static ByteImage mask_at(int left, int top) {
    ByteImage mask(60, 48, 1);
    for (int y = top; y < top + 16; ++y) std::fill_n(mask.pixel(left, y), 12, std::uint8_t{1});
    return mask;
  }

  testing::TempFolder folder_;
};

TEST(CloseWindow, PutsTheMaskInItsMiddleAndFillsIt) {
  ByteImage mask(50, 40, 1);
  for (int y = 10; y < 30; ++y) mask(20, y) = mask(27, y) = 1;
  const Window window = close_window(mask, 96).value();
  EXPECT_DOUBLE_EQ(window.scale, kCloseFill * 96 / 20);
  EXPECT_DOUBLE_EQ(window.left_px + 48 / window.scale, 24);
  EXPECT_DOUBLE_EQ(window.top_px + 48 / window.scale, 20);
  EXPECT_FALSE(close_window(ByteImage(5, 5, 1), 96));
  EXPECT_FALSE(close_window({}, 96));
}

// Weights that were trained on whole pictures see the window as their whole picture, with what is around it cut away.
TEST_F(NearViewTest, TheMaskIsSeenAsThePictureCutOutThere) {
  const Image picture = random_picture(60, 48, 0.2F, 0.6F);
  const ByteImage mask = mask_at(20, 14);
  const Image mesh = random_picture(60, 48, -1, 1);
  const FaceLayers layers = FaceNet(weights("32"), {.threads = 1}).layers(picture, {}, mask, mesh);
  const Window window = close_window(mask, kPicturePx).value();
  const FaceLayers near = FaceNet(weights(""), {.threads = 1})
                              .layers(resampled(picture, window), resampled(ByteImage(60, 48, 1), window, 7),
                                      resampled(mask, window), resampled(mesh, window));
  const Image shading = resampled(near.shading, window.back_to(60, 48));
  const Image error = resampled(near.normal_error_rad, window.back_to(60, 48));
  for (int y = 15; y < 29; ++y) {
    for (int x = 21; x < 31; ++x) {
      EXPECT_NEAR(layers.normal_error_rad(x, y), error(x, y), 1e-5F);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(layers.shading(x, y, c), shading(x, y, c), 1e-5F);
    }
  }
}

// A face at another place of the same surroundings is the same face.
TEST_F(NearViewTest, AFaceThatMovesTakesItsLayersAlong) {
  const FaceNet net(weights("32"), {.threads = 1});
  const Image tile = random_picture(40, 40, 0.2F, 0.6F);
  const auto layers_at = [&](int left, int top) {
    Image picture(60, 48, 3, 0.1F);
    for (int y = 0; y < 40; ++y) std::copy_n(tile.pixel(0, y), 120, picture.pixel(left, top + y));
    return net.layers(picture, {}, mask_at(left + 14, top + 12), {});
  };
  const FaceLayers one = layers_at(4, 2);
  const FaceLayers two = layers_at(13, 7);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 12; ++x) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(two.highlight(27 + x, 19 + y, c), one.highlight(18 + x, 14 + y, c), 1e-5F);
        EXPECT_NEAR(two.normal_cam(27 + x, 19 + y, c), one.normal_cam(18 + x, 14 + y, c), 1e-5F);
      }
    }
  }
}

TEST_F(NearViewTest, LayersAreBoundedAndUnitWhateverThePictureHas) {
  Image picture = random_picture(60, 48, 0, 1);
  picture(30, 20, 1) = std::numeric_limits<float>::quiet_NaN();
  picture(25, 22, 0) = std::numeric_limits<float>::infinity();
  for (const ByteImage& mask : {ByteImage(), mask_at(48, 32), mask_at(0, 0), ByteImage(60, 48, 1)}) {
    const FaceLayers layers = FaceNet(weights("32")).layers_both_ways(picture, ByteImage(60, 48, 1), mask, {});
    for (std::size_t i = 0; i < picture.values().size(); ++i) {
      ASSERT_TRUE(std::isfinite(layers.shading.data()[i]));
      ASSERT_GE(layers.highlight.data()[i], 0);
      if (!std::isfinite(picture.data()[i])) continue;
      ASSERT_LE(layers.highlight.data()[i], picture.data()[i]);
    }
    for (std::size_t i = 0; i < picture.values().size(); i += 3) {
      const float* n = layers.normal_cam.data() + i;
      ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-4F);
    }
  }
}

TEST_F(NearViewTest, AnImpossibleSizeInTheWeightsIsASentence) {
  for (const char* px : {"0", "many", "96.5", "100000"})
    expect_error(ExitCode::kModel, {"picture_px", px}, [&] { FaceNet{weights(px)}; });
}

}  // namespace
}  // namespace faceprobe::net
