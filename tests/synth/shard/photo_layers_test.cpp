#include "faceprobe/synth/photo_layers.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/region.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

// Skin of one colour with a bright spot.
Sample spot() {
  Sample sample;
  sample.photo = ByteImage(16, 16, 3);
  sample.clip = ByteImage(16, 16, 1);
  sample.highlight = sample.diffuse = Image(16, 16, 3);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      for (int c = 0; c < 3; ++c) {
        sample.highlight(x, y, c) = 0.4F * std::exp(-0.05F * static_cast<float>((x - 8) * (x - 8) + (y - 8) * (y - 8)));
        sample.diffuse(x, y, c) = c == 0 ? 0.3F : 0.2F;
        const float encoded = srgb_from_linear(sample.highlight(x, y, c) + sample.diffuse(x, y, c));
        sample.photo(x, y, c) = static_cast<std::uint8_t>(std::lround(255.0F * encoded));
      }
    }
  }
  return sample;
}

TEST(PhotoLayers, KeepTheShareOfEachLayerWhateverTheToneCurve) {
  Sample sample = spot();
  for (std::uint8_t& code : sample.photo.values()) code = static_cast<std::uint8_t>(code / 2);  // a camera of its own
  const PhotoLayers layers = photo_layers(sample);
  for (std::size_t i = 0; i < layers.linear.values().size(); ++i) {
    const float share = sample.highlight.data()[i] / (sample.highlight.data()[i] + sample.diffuse.data()[i]);
    EXPECT_NEAR(layers.highlight.data()[i], share * layers.linear.data()[i], 1e-6F);
  }
}

TEST(PhotoLayers, AClippedChannelKeepsItsDiffuseLight) {
  Sample sample = spot();
  std::fill(sample.highlight.values().begin(), sample.highlight.values().end(), 5.0F);
  std::fill(sample.diffuse.values().begin(), sample.diffuse.values().end(), 0.3F);
  std::fill(sample.photo.values().begin(), sample.photo.values().end(), std::uint8_t{255});
  std::fill(sample.clip.values().begin(), sample.clip.values().end(), std::uint8_t{7});
  const PhotoLayers layers = photo_layers(sample);
  for (const float value : layers.highlight.values()) EXPECT_NEAR(value, 0.7F, 1e-6F);
}

TEST(FaceMask, IsTheHullOfTheLandmarksWithoutEyes) {
  ViewLayers view;
  view.region = ByteImage(40, 40, 1, static_cast<std::uint8_t>(Region::kCheeks));
  view.faces.resize(1);
  view.region(20, 20) = static_cast<std::uint8_t>(Region::kEyes);
  view.faces[0].dense_landmarks_px.resize(4, 2);
  view.faces[0].dense_landmarks_px << 10, 10, 30, 10, 30, 30, 10, 30;
  const ByteImage mask = face_mask(view, 1.0F);
  int inside = 0;
  for (const std::uint8_t value : mask.values()) inside += value;
  EXPECT_EQ(inside, 20 * 20 - 1);
  EXPECT_EQ(mask(20, 20), 0);
  EXPECT_EQ(mask(10, 10), 1);
  EXPECT_EQ(mask(9, 10), 0);
  const ByteImage larger = face_mask(view, 1.5F);
  int grown = 0;
  for (const std::uint8_t value : larger.values()) grown += value;
  EXPECT_EQ(grown, 30 * 30 - 1);
}

// Jaw at the bottom, brows on a line, the nose's base a known way below them.
TEST(FaceMask, OfThe68LandmarksHasAForehead) {
  ViewLayers view;
  view.region = ByteImage(100, 100, 1, static_cast<std::uint8_t>(Region::kForehead));
  view.faces.resize(1);
  Eigen::MatrixX2f& marks = view.faces[0].landmarks_px;
  marks.resize(68, 2);
  for (Eigen::Index i = 0; i < 68; ++i) marks.row(i) << 50, 60;
  marks.row(0) << 20, 50;  // the jaw's ends and the chin
  marks.row(16) << 80, 50;
  marks.row(8) << 50, 90;
  for (Eigen::Index i = 17; i <= 26; ++i) marks.row(i) << 30 + 40 * static_cast<float>(i - 17) / 9, 45;
  marks.row(33) << 50, 65;
  const ByteImage mask = face_mask(view, 1.0F);
  EXPECT_EQ(mask(50, 88), 1);
  EXPECT_EQ(mask(50, 92), 0);
  // 20 pixels from brows to nose: the hull ends 16 above the brows.
  EXPECT_EQ(mask(50, 30), 1);
  EXPECT_EQ(mask(50, 27), 0);
  EXPECT_EQ(mask(20, 30), 0);
}

}  // namespace
}  // namespace faceprobe::synth
