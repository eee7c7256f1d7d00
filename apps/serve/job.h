#pragma once
// One piece of work that takes a while: how far it is, for those who wait for it, and whether it is still wanted, for the one who does it.
// Safe from several threads.

#include "serve/failure.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

namespace faceprobe::serve {

enum class JobPhase { kWaiting, kRunning, kDone, kFailed };

struct JobState {
  JobPhase phase = JobPhase::kWaiting;
  std::string stage{};  // what it is at, for people
  double share = 0;     // 0..1 of the way
  double elapsed_seconds = 0;
  std::optional<double> seconds_left{};
  std::optional<Failure> failure{};  // of kFailed

  bool ended() const { return phase == JobPhase::kDone || phase == JobPhase::kFailed; }
};

Json job_json(const JobState& state);

class Job {
 public:
  JobState state() const;
  // The state once it is another than that of change `seen`, or after a while; `seen` becomes its number. 0 is no state's.
  JobState wait(int& seen, std::chrono::milliseconds most) const;

  // A running job that has taken long enough to tell says how long it will be.
  void progress(const std::string& stage, double share);
  void succeed();
  void fail(Failure failure);

  void stop();
  bool stopped() const;

 private:
  using Clock = std::chrono::steady_clock;
  JobState timed() const;
  void changed();

  mutable std::mutex mutex_;
  mutable std::condition_variable change_;
  JobState state_;
  int changes_ = 1;
  bool stopped_ = false;
  std::optional<Clock::time_point> start_, end_;
};

}  // namespace faceprobe::serve
