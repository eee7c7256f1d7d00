#include "faceprobe/synth/contact_sheet.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

Sample plain_sample(std::uint8_t grey) {
  Sample sample;
  sample.photo = ByteImage(4, 3, 3, grey);
  sample.clip = ByteImage(4, 3, 1);
  sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(4, 3, 3, 0.5F);
  return sample;
}

TEST(ContactSheet, HoldsEveryPhotoOnceInRows) {
  const std::vector<Sample> samples = {plain_sample(10), plain_sample(20), plain_sample(30)};
  const ByteImage sheet = contact_sheet(samples, 2);
  EXPECT_EQ(sheet.width(), 2 * 4 + 3 * 2);
  EXPECT_EQ(sheet.height(), 2 * 3 + 3 * 2);
  std::array<int, 256> count{};
  for (const std::uint8_t value : sheet.values()) ++count[value];
  for (const std::size_t grey : {10U, 20U, 30U}) EXPECT_EQ(count[grey], 4 * 3 * 3);
  EXPECT_EQ(sheet(2, 2, 0), 10);
  EXPECT_EQ(sheet(2 + 4 + 2, 2, 0), 20);
  EXPECT_EQ(sheet(2, 2 + 3 + 2, 0), 30);
}

TEST(ContactSheet, IsEmptyWithoutSamples) { EXPECT_TRUE(contact_sheet({}, 4).empty()); }

TEST(LayerSheet, ShowsNineLayersAndColoursNormalsByAxis) {
  ViewLayers view;
  view.normal = Image(4, 3, 3);
  view.normal(0, 0, 2) = 1;  // towards the camera: (128, 128, 255)
  view.depth_m = Image(4, 3, 1);
  view.region = ByteImage(4, 3, 1);
  const ByteImage sheet = layer_sheet(plain_sample(10), view);
  EXPECT_EQ(sheet.width(), 9 * (4 + 2) + 2);
  EXPECT_EQ(sheet.height(), 3 + 4);
  const int left = 2 + 5 * (4 + 2);
  EXPECT_EQ(sheet(left, 2, 0), 128);
  EXPECT_EQ(sheet(left, 2, 2), 255);
  EXPECT_EQ(sheet(left + 1, 2, 2), 0);  // background
}

}  // namespace
}  // namespace faceprobe::synth
