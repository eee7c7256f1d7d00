#include "faceprobe/pipeline/self_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace faceprobe::pipeline {
namespace {

TEST(SelfTest, AnInstallationThatWorksPassesAll) {
  const std::vector<Check> checks = self_test();
  EXPECT_GE(checks.size(), 9U);
  for (const Check& check : checks) {
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
    EXPECT_FALSE(check.detail.empty()) << check.name;
  }
}

}  // namespace
}  // namespace faceprobe::pipeline
