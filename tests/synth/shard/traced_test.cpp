#include "faceprobe/synth/traced.h"

#include "faceprobe/core/error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace faceprobe::synth {
namespace {

TracedPhoto photo(float first) {
  TracedPhoto out{Eigen::VectorXf::LinSpaced(6, first, first + 1), Eigen::MatrixX3f::Random(4, 3)};
  return out;
}

TEST(Traced, ComeBackInOrder) {
  const testing::TempFolder folder;
  const std::vector<TracedPhoto> all = {photo(0), photo(1), photo(2)};
  write_traced(folder.path(), 1, std::span(all).subspan(2));
  write_traced(folder.path(), 0, std::span(all).first(2));
  const std::vector<TracedPhoto> back = read_traced(folder.path());
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back[i].features, all[i].features);
    EXPECT_EQ(back[i].light, all[i].light);
  }
}

TEST(Traced, NoneIsNoFaultAndDamageIs) {
  const testing::TempFolder folder;
  EXPECT_TRUE(read_traced(folder.path()).empty());
  std::ofstream(folder / traced_name(0)) << "no tensors";
  EXPECT_THROW(read_traced(folder.path()), Error);
}

}  // namespace
}  // namespace faceprobe::synth
