#include "train/augment.h"

#include "faceprobe/core/region.h"
#include "train/batch.h"
#include "train/small_data.h"

#include <gtest/gtest.h>

#include <set>

namespace faceprobe::train {
namespace {

TEST(Augment, AGainScalesBothLayersAndClipsAtWhite) {
  TrainingPicture picture{Image(2, 1, 3, 0.5F), ByteImage(2, 1, 3), ByteImage(2, 1, 1, 1), Image(2, 1, 3, 0.2F),
                          ByteImage(2, 1, 1, 1)};
  apply_gain({1.5F, 1.0F, 2.5F}, picture);
  EXPECT_FLOAT_EQ(picture.linear(0, 0, 0), 0.75F);
  EXPECT_FLOAT_EQ(picture.highlight(0, 0, 0), 0.3F);
  EXPECT_EQ(picture.clip(0, 0, 0), 0);
  EXPECT_FLOAT_EQ(picture.linear(0, 0, 2), 1.0F);
  EXPECT_FLOAT_EQ(picture.highlight(0, 0, 2), 0.25F);  // white less the diffuse 0.75
  EXPECT_EQ(picture.clip(0, 0, 2), 1);
}

TEST(Augment, LayersStayInsideThePictureWhateverIsDrawn) {
  const DataFolder folder("augment", 24, 6);
  const synth::ShardReader reader(folder.data());
  TrainConfig config;
  config.augment.occluder_share = 0.5;
  config.augment.grey_share = 0.5;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random({seed});
    const TrainingPicture picture = draw_picture(reader, static_cast<int>(seed % 6), config, random);
    for (std::size_t i = 0; i < picture.linear.values().size(); ++i) {
      ASSERT_LE(picture.highlight.data()[i], picture.linear.data()[i] + 1e-6F) << seed;
      ASSERT_GE(picture.highlight.data()[i], 0) << seed;
      ASSERT_LE(picture.linear.data()[i], 1.0F) << seed;
    }
  }
}

TEST(Augment, PicturesHaveTheSizeTheConfigSaysAndStayBounded) {
  const DataFolder folder("sized", 24, 6);
  const synth::ShardReader reader(folder.data());
  TrainConfig config;
  config.picture_px = 32;
  config.augment.close_share = 0.5;
  config.augment.zoom_share = 0.5;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random({seed});
    const TrainingPicture picture = draw_picture(reader, static_cast<int>(seed % 6), config, random);
    ASSERT_EQ(picture.linear.width(), 32);
    ASSERT_EQ(picture.linear.height(), 32);
    for (std::size_t i = 0; i < picture.linear.values().size(); ++i)
      ASSERT_LE(picture.highlight.data()[i], picture.linear.data()[i]) << seed;
  }
}

// A backdrop comes behind the person, not over it, and nothing else is drawn otherwise because of it.
TEST(Augment, ABackdropIsBehindThePerson) {
  const DataFolder folder("backdrop", 24, 2);
  const synth::ShardReader reader(folder.data());
  TrainConfig config;
  config.architecture = "face";
  config.augment.zoom_share = 1;  // these faces fill their pictures; what is smaller has something around it
  TrainConfig with = config;
  with.augment.backdrop_share = 1;
  int changed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random one({seed});
    Random other({seed});
    const TrainingPicture plain = draw_picture(reader, 0, config, one);
    const TrainingPicture picture = draw_picture(reader, 0, with, other);
    ASSERT_EQ(picture.region, plain.region);
    for (std::size_t i = 0; i < picture.region.values().size(); ++i) {
      const bool behind = picture.region.data()[i] == static_cast<std::uint8_t>(Region::kNone);
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
        if (behind) {
          ASSERT_EQ(picture.highlight.data()[c], 0);
          changed += picture.linear.data()[c] != plain.linear.data()[c] ? 1 : 0;
        } else {
          ASSERT_EQ(picture.linear.data()[c], plain.linear.data()[c]);
        }
      }
    }
  }
  EXPECT_GT(changed, 0);
}

TEST(BatchOrder, EachRoundHoldsEverySampleOnce) {
  std::multiset<int> first;
  for (std::int64_t step = 0; step < 5; ++step) {
    for (const int sample : samples_of_step(9, step, 4, 20)) first.insert(sample);
  }
  EXPECT_EQ(first.size(), 20U);
  EXPECT_EQ(std::set<int>(first.begin(), first.end()).size(), 20U);
  EXPECT_NE(samples_of_step(9, 0, 4, 20), samples_of_step(9, 5, 4, 20));
  EXPECT_EQ(samples_of_step(9, 7, 4, 20), samples_of_step(9, 7, 4, 20));
}

TEST(PlainBatch, HoldsThePicturesPixelByPixel) {
  const DataFolder folder("plain", 24, 3);
  const synth::ShardReader reader(folder.data());
  const Batch batch = plain_batch(reader, {2, 0}, TrainConfig{});
  const TrainingPicture picture = plain_picture(reader, 0, TrainConfig{});
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(batch.linear[1][c][y][x].item<float>(), picture.linear(x, y, c));
        ASSERT_EQ(batch.highlight[1][c][y][x].item<float>(), picture.highlight(x, y, c));
      }
      ASSERT_EQ(batch.skin[1][0][y][x].item<float>(), static_cast<float>(picture.skin(x, y)));
    }
  }
}

TEST(BatchSource, GivesTheSameBatchesFromTheMiddleOn) {
  const DataFolder folder("source", 24, 10);
  const synth::ShardReader reader(folder.data());
  TrainConfig config;
  config.batch = 3;
  BatchSource from_start(reader, config, 0);
  for (int i = 0; i < 5; ++i) from_start.next();
  BatchSource from_five(reader, config, 5);
  const Batch a = from_start.next();
  const Batch b = from_five.next();
  EXPECT_TRUE(torch::equal(a.linear, b.linear));
  EXPECT_TRUE(torch::equal(a.highlight, b.highlight));
  EXPECT_TRUE(torch::equal(a.mask, b.mask));
}

}  // namespace
}  // namespace faceprobe::train
