#include "faceprobe/core/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace faceprobe {
namespace {

TEST(ParallelFor, VisitsEachIndexOnceForAnyThreadCount) {
  for (const int threads : {0, 1, 2, 3, 8, 64}) {
    for (const int count : {0, 1, 7, 1000}) {
      std::vector<int> visits(static_cast<std::size_t>(count), 0);
      parallel_for(count, threads, [&](int first, int last) {
        for (int i = first; i < last; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << " threads";
    }
  }
}

TEST(ParallelFor, RethrowsWhatTheBodyThrows) {
  const auto fail_late = [](int, int last) {
    if (last == 100) throw std::runtime_error("last block");
  };
  EXPECT_THROW(parallel_for(100, 4, fail_late), std::runtime_error);
}

}  // namespace
}  // namespace faceprobe
