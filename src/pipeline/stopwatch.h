#pragma once
// Wall-clock time per stage, for the report.

#include "faceprobe/pipeline/estimate.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace faceprobe::pipeline {

class Stopwatch {
 public:
  explicit Stopwatch(std::vector<StageTime>& times, StageDone done = {})
      : times_(times), done_(std::move(done)), start_(Clock::now()) {}

  // Books the time since the last call on a stage; several calls with one name add up.
  void lap(const std::string& stage) {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    const auto known = std::find_if(times_.begin(), times_.end(), [&](const StageTime& t) { return t.stage == stage; });
    if (known != times_.end()) {
      known->seconds += seconds;
    } else {
      times_.push_back({stage, seconds});
    }
    if (done_) done_(stage);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime>& times_;
  StageDone done_;
  Clock::time_point start_;
};

}  // namespace faceprobe::pipeline
