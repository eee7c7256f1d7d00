#include "synth/skin/texture.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "synth/skin/skin_fixture.h"

#include <gtest/gtest.h>
#include <cmath>

namespace faceprobe::synth {
namespace {

using testing::plain_texture;
using testing::varied_texture;

TEST(SkinTexture, MeanSkinLooksPastBrowsAndBeards) {
  ByteImage texture = plain_texture(128, {190, 150, 130});
  for (int y = 50; y < 80; ++y) {
    for (int x = 30; x < 70; ++x) texture(x, y, 0) = texture(x, y, 1) = texture(x, y, 2) = 30;
  }
  const SkinTexture prepared = prepare_texture("beard", texture);
  for (int c = 0; c < 3; ++c) {
    const float skin =
        linear_from_srgb(static_cast<float>(std::array{190, 150, 130}[static_cast<std::size_t>(c)]) / 255.0F);
    EXPECT_NEAR(prepared.mean_skin[c] / skin, 1.0F, 0.01F);  // what the robust weights leave of a fifth of the area
  }
}

TEST(SkinTexture, TexelCentresReturnTheTexels) {
  const ByteImage picture = varied_texture(64);
  const SkinTexture texture = prepare_texture("varied", picture);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Eigen::Vector2f uv((static_cast<float>(x) + 0.5F) / 64.0F, 1.0F - (static_cast<float>(y) + 0.5F) / 64.0F);
      const TextureSample sample = sample_texture(texture, uv, 0.0F);
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(std::lround(255.0F * srgb_from_linear(std::exp(sample.log_linear[c]))), picture(x, y, c))
            << x << ' ' << y;
      }
    }
  }
}

TEST(SkinTexture, WideFootprintsSeeAverages) {
  ByteImage checks(256, 256, 3);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      for (int c = 0; c < 3; ++c) checks(x, y, c) = (x + y) % 2 == 0 ? 220 : 90;
    }
  }
  const SkinTexture texture = prepare_texture("checks", checks);
  const float mean = 0.5F * (linear_from_srgb(220.0F / 255.0F) + linear_from_srgb(90.0F / 255.0F));
  for (const float footprint : {2.0F / 256.0F, 4.0F / 256.0F}) {
    const TextureSample sample = sample_texture(texture, {0.31F, 0.47F}, footprint);
    EXPECT_NEAR(std::exp(sample.log_linear[1]) / mean, 1.0F, 0.005F);  // half a code value, 1/360 of the light there
  }
}

TEST(SkinTexture, BroadDeviationIsShadingNotFeatures) {
  ByteImage texture = plain_texture(256, {190, 150, 130});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const bool brow = std::abs(x - 128) < 20 && std::abs(y - 100) < 4;
      const float ramp = 1.0F + 0.2F * (static_cast<float>(x) - 127.5F) / 128.0F;
      for (int c = 0; c < 3; ++c) {
        const float linear =
            linear_from_srgb(static_cast<float>(texture(x, y, c)) / 255.0F) * ramp * (brow ? 0.2F : 1.0F);
        texture(x, y, c) = static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(linear)));
      }
    }
  }
  const SkinTexture prepared = prepare_texture("ramp", texture);
  const auto broad = [&](float u, float v) { return sample_texture(prepared, {u, v}, 0.0F).log_broad[1]; };
  // Far from the edge of the picture the blur keeps a ramp; the mean is taken where the ramp is 1.
  EXPECT_NEAR(broad(0.75F, 0.3F) - broad(0.25F, 0.3F), std::log(1.1F / 0.9F), 0.02F);
  EXPECT_NEAR(broad(0.5F, 1.0F - 100.0F / 256.0F), 0.0F, 0.03F);  // log(.2) = -1.6 there, were the brow not left out
}

TEST(SkinTexture, RefusesWhatIsNoTexture) {
  const auto code_of = [](ByteImage picture) {
    try {
      prepare_texture("bad", std::move(picture));
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::kOk;
  };
  EXPECT_EQ(code_of(ByteImage()), ExitCode::kInput);
  EXPECT_EQ(code_of(ByteImage(8, 8, 1)), ExitCode::kInput);
  EXPECT_EQ(code_of(ByteImage(8, 8, 3)), ExitCode::kInput);  // black
  EXPECT_EQ(code_of(plain_texture(1, {200, 150, 120})), ExitCode::kOk);
}

}  // namespace
}  // namespace faceprobe::synth
