#include "train/batch.h"

#include "train/small_data.h"

#include <gtest/gtest.h>
#include <vector>

namespace faceprobe::train {
namespace {

TrainConfig small_config() {
  TrainConfig config;
  config.batch = 3;
  config.seed = 9;
  return config;
}

std::vector<Batch> batches(const synth::ShardReader& reader, std::int64_t first_step, int count, int workers) {
  BatchSource source(reader, small_config(), first_step, false, workers);
  std::vector<Batch> out;
  for (int i = 0; i < count; ++i) out.push_back(source.next());
  return out;
}

TEST(BatchSource, TheBatchesAreTheSameWithAnyNumberOfWorkers) {
  const DataFolder folder("workers", 16, 8);
  const synth::ShardReader reader(folder.data());
  constexpr int kSteps = 24;  // several times round eight samples, and more than lie ready
  const std::vector<Batch> one = batches(reader, 0, kSteps, 1);
  const std::vector<Batch> three = batches(reader, 0, kSteps, 3);
  for (std::size_t i = 0; i < kSteps; ++i) {
    EXPECT_TRUE(torch::equal(one[i].linear, three[i].linear)) << i;
    EXPECT_TRUE(torch::equal(one[i].clip, three[i].clip)) << i;
    EXPECT_TRUE(torch::equal(one[i].mask, three[i].mask)) << i;
    EXPECT_TRUE(torch::equal(one[i].highlight, three[i].highlight)) << i;
    EXPECT_TRUE(torch::equal(one[i].skin, three[i].skin)) << i;
    if (i > 0) {
      EXPECT_FALSE(torch::equal(one[i].linear, one[i - 1].linear)) << i;
    }
  }
  // Taken up in the middle.
  EXPECT_TRUE(torch::equal(batches(reader, 10, 1, 3)[0].linear, one[10].linear));
}

TEST(BatchSource, AProcessorNeedsOneWorker) {
  EXPECT_EQ(usual_workers(false), 1);
  EXPECT_GE(usual_workers(true), 1);
}

TEST(BatchSource, ARepeatedBatchIsTheFirst) {
  const DataFolder folder("repeated", 16, 8);
  const synth::ShardReader reader(folder.data());
  const Batch first = batches(reader, 0, 1, 1)[0];
  BatchSource source(reader, small_config(), 0, true, 3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(torch::equal(source.next().linear, first.linear)) << i;
}

}  // namespace
}  // namespace faceprobe::train
