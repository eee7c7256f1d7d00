#include "serve/job.h"

#include <utility>

namespace faceprobe::serve {
namespace {

constexpr double kLeastSeconds = 0.5;  // before a guess of the time left is worth telling
constexpr double kLeastShare = 0.02;

const char* phase_name(JobPhase phase) {
  switch (phase) {
    case JobPhase::kWaiting: return "waiting";
    case JobPhase::kRunning: return "running";
    case JobPhase::kDone: return "done";
    default: return "failed";
  }
}

}  // namespace

Json job_json(const JobState& state) {
  Json json = {{"state", phase_name(state.phase)},
               {"stage", state.stage},
               {"share", state.share},
               {"elapsed_seconds", state.elapsed_seconds}};
  if (state.seconds_left) json["seconds_left"] = *state.seconds_left;
  if (state.failure) json["error"] = failure_json(*state.failure)["error"];
  return json;
}

JobState Job::timed() const {
  JobState state = state_;
  if (!start_) return state;
  state.elapsed_seconds = std::chrono::duration<double>(end_.value_or(Clock::now()) - *start_).count();
  if (state.phase == JobPhase::kRunning && state.share > kLeastShare && state.elapsed_seconds > kLeastSeconds)
    state.seconds_left = state.elapsed_seconds * (1 / state.share - 1);
  return state;
}

JobState Job::state() const {
  const std::lock_guard lock(mutex_);
  return timed();
}

JobState Job::wait(int& seen, std::chrono::milliseconds most) const {
  std::unique_lock lock(mutex_);
  change_.wait_for(lock, most, [&] { return changes_ != seen; });
  seen = changes_;
  return timed();
}

void Job::changed() {
  ++changes_;
  change_.notify_all();
}

void Job::progress(const std::string& stage, double share) {
  const std::lock_guard lock(mutex_);
  if (!start_) start_ = Clock::now();
  state_.phase = JobPhase::kRunning;
  state_.stage = stage;
  state_.share = share;
  changed();
}

void Job::succeed() {
  const std::lock_guard lock(mutex_);
  end_ = Clock::now();
  state_.phase = JobPhase::kDone;
  state_.stage.clear();
  state_.share = 1;
  changed();
}

void Job::fail(Failure failure) {
  const std::lock_guard lock(mutex_);
  end_ = Clock::now();
  state_.phase = JobPhase::kFailed;
  state_.failure = std::move(failure);
  changed();
}

void Job::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed();
}

bool Job::stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

}  // namespace faceprobe::serve
