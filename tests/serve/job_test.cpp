#include "serve/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace faceprobe::serve {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kLong{10'000};  // what nobody is to wait for

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

// Until the job has run for longer than it had when this was called.
void let_time_pass(const Job& job) {
  const double before = job.state().elapsed_seconds;
  const auto start = steady_clock::now();
  while (!(job.state().elapsed_seconds > before) && seconds_since(start) < 5) std::this_thread::yield();
}

TEST(Job, WaitsThenRunsThenIsDone) {
  Job job;
  EXPECT_EQ(job.state().phase, JobPhase::kWaiting);
  EXPECT_FALSE(job.state().ended());
  EXPECT_EQ(job.state().elapsed_seconds, 0);
  job.progress("Looking", 0.25);
  JobState state = job.state();
  EXPECT_EQ(state.phase, JobPhase::kRunning);
  EXPECT_EQ(state.stage, "Looking");
  EXPECT_EQ(state.share, 0.25);
  EXPECT_FALSE(state.ended());
  job.succeed();
  state = job.state();
  EXPECT_EQ(state.phase, JobPhase::kDone);
  EXPECT_TRUE(state.ended());
  EXPECT_EQ(state.stage, "");
  EXPECT_EQ(state.share, 1);
  EXPECT_FALSE(state.failure);
}

TEST(Job, AFailureKeepsItsSentence) {
  Job job;
  job.progress("Looking", 0.25);
  job.fail({FailureKind::kNoFace, "No face."});
  const JobState state = job.state();
  EXPECT_EQ(state.phase, JobPhase::kFailed);
  EXPECT_TRUE(state.ended());
  ASSERT_TRUE(state.failure);
  EXPECT_EQ(state.failure->kind, FailureKind::kNoFace);
  const Json json = job_json(state);
  EXPECT_EQ(json["state"], "failed");
  EXPECT_EQ(json["error"], (Json{{"kind", "no_face"}, {"message", "No face."}}));
}

TEST(Job, JsonHasAnErrorAndATimeLeftOnlyWhereThereIsOne) {
  Job job;
  EXPECT_EQ(job_json(job.state()),
            (Json{{"state", "waiting"}, {"stage", ""}, {"share", 0.0}, {"elapsed_seconds", 0.0}}));
  job.succeed();
  const Json json = job_json(job.state());
  EXPECT_EQ(json["state"], "done");
  EXPECT_FALSE(json.contains("error"));
  EXPECT_FALSE(json.contains("seconds_left"));
}

TEST(Job, TheFirstWaitIsNone) {
  const Job job;
  int seen = 0;
  const auto start = steady_clock::now();
  EXPECT_EQ(job.wait(seen, kLong).phase, JobPhase::kWaiting);
  EXPECT_NE(seen, 0);
  EXPECT_LT(seconds_since(start), 5);
}

TEST(Job, WaitEndsWithoutAChangeAfterAWhile) {
  const Job job;
  int seen = 0;
  job.wait(seen, kLong);
  const int before = seen;
  const auto start = steady_clock::now();
  job.wait(seen, milliseconds(20));
  EXPECT_EQ(seen, before);
  EXPECT_GE(seconds_since(start), 0.02);
}

TEST(Job, AChangeWakesThoseWhoWait) {
  Job job;
  int seen = 0;
  job.wait(seen, kLong);
  const auto start = steady_clock::now();
  std::thread worker([&] { job.progress("Drawing", 0.5); });
  const JobState state = job.wait(seen, kLong);
  worker.join();
  EXPECT_EQ(state.phase, JobPhase::kRunning);
  EXPECT_LT(seconds_since(start), 5);
}

TEST(Job, AChangeBetweenTwoWaitsIsNotMissed) {
  Job job;
  int seen = 0;
  job.wait(seen, kLong);
  job.progress("Drawing", 0.5);
  job.succeed();
  const auto start = steady_clock::now();
  EXPECT_EQ(job.wait(seen, kLong).phase, JobPhase::kDone);
  EXPECT_LT(seconds_since(start), 5);
}

TEST(Job, EveryListenerSeesTheEnd) {
  Job job;
  std::vector<std::thread> listeners;
  std::atomic<int> ends = 0;
  for (int i = 0; i < 4; ++i) {
    listeners.emplace_back([&] {
      int seen = 0;
      for (int wakes = 0; wakes < 1000; ++wakes) {
        if (!job.wait(seen, kLong).ended()) continue;
        ++ends;
        return;
      }
    });
  }
  for (int i = 0; i < 200; ++i) job.progress("Drawing", i / 200.0);
  job.succeed();
  for (std::thread& listener : listeners) listener.join();
  EXPECT_EQ(ends, 4);
}

TEST(Job, TimeStandsStillBeforeTheStartAndAfterTheEnd) {
  Job job;
  job.progress("Drawing", 0.1);
  let_time_pass(job);
  const double running = job.state().elapsed_seconds;
  EXPECT_GT(running, 0);
  job.fail({FailureKind::kInput, "Nothing."});
  const double whole = job.state().elapsed_seconds;
  EXPECT_GE(whole, running);
  const auto start = steady_clock::now();
  while (seconds_since(start) < 1e-3) std::this_thread::yield();
  EXPECT_EQ(job.state().elapsed_seconds, whole);
}

TEST(Job, TimeLeftIsToldOnceItMeansSomething) {
  Job job;
  EXPECT_FALSE(job.state().seconds_left);
  job.progress("Drawing", 0.25);
  if (const JobState early = job.state(); early.elapsed_seconds < 0.4) {
    EXPECT_FALSE(early.seconds_left) << "guessed after " << early.elapsed_seconds << " s";
  }
  int seen = 0;
  JobState state;
  const auto start = steady_clock::now();
  while (!state.seconds_left && seconds_since(start) < 5) state = job.wait(seen, milliseconds(20));
  ASSERT_TRUE(state.seconds_left);
  EXPECT_NEAR(*state.seconds_left, 3 * state.elapsed_seconds, 1e-9);  // a quarter of the way; one rounding
  job.progress("Drawing", 0.01);
  EXPECT_FALSE(job.state().seconds_left);  // too little of the way to tell
  job.progress("Drawing", 0.9);
  EXPECT_TRUE(job.state().seconds_left);
  job.succeed();
  EXPECT_FALSE(job.state().seconds_left);
}

TEST(Job, ToBeStoppedIsAWishThatWakesAndEndsNothing) {
  Job job;
  job.progress("Drawing", 0.5);
  int seen = 0;
  job.wait(seen, kLong);
  EXPECT_FALSE(job.stopped());
  const auto start = steady_clock::now();
  std::thread other([&] { job.stop(); });
  EXPECT_EQ(job.wait(seen, kLong).phase, JobPhase::kRunning);
  other.join();
  EXPECT_LT(seconds_since(start), 5);
  EXPECT_TRUE(job.stopped());
}

}  // namespace
}  // namespace faceprobe::serve
