#include "serve/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace faceprobe::serve {
namespace {

// A task that says when it has begun and runs until it is let go.
class Gate {
 public:
  std::function<void()> task() {
    return [this] {
      begun_.set_value();
      open_.get_future().wait();
    };
  }
  void wait_for_begin() { begun_.get_future().wait(); }
  void open() { open_.set_value(); }

 private:
  std::promise<void> begun_, open_;
};

TEST(Worker, DoesOneAfterAnotherInOrder) {
  Gate gate;
  std::vector<int> order;  // the worker's own until the last task has run
  std::promise<void> all;
  Worker worker(10);
  ASSERT_TRUE(worker.submit(gate.task()));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(worker.submit([&order, i] { order.push_back(i); }));
  ASSERT_TRUE(worker.submit([&] { all.set_value(); }));
  gate.wait_for_begin();
  EXPECT_TRUE(order.empty()) << "the first one runs still";
  gate.open();
  all.get_future().wait();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Worker, RefusesWhenTooManyWait) {
  Gate gate;
  std::promise<void> second;
  std::atomic<bool> refused_ran = false;
  Worker worker(2);
  ASSERT_TRUE(worker.submit(gate.task()));
  gate.wait_for_begin();  // what runs does not wait
  EXPECT_TRUE(worker.submit([] {}));
  EXPECT_TRUE(worker.submit([&] { second.set_value(); }));
  EXPECT_FALSE(worker.submit([&] { refused_ran = true; }));
  gate.open();
  second.get_future().wait();
  std::promise<void> later;
  EXPECT_TRUE(worker.submit([&] { later.set_value(); }));  // there is room again
  later.get_future().wait();
  EXPECT_FALSE(refused_ran);
}

TEST(Worker, AtItsEndWhatRunsIsFinishedAndWhatWaitsIsDropped) {
  constexpr int kTasks = 2000;  // two seconds of work, which no end has to wait for
  Gate gate;
  std::atomic<int> begun = 0, ended = 0;
  const auto held = std::make_shared<int>(0);
  std::optional<Worker> worker(std::in_place, kTasks + 1);
  ASSERT_TRUE(worker->submit(gate.task()));
  for (int i = 0; i < kTasks; ++i) {
    ASSERT_TRUE(worker->submit([&begun, &ended, held] {
      ++begun;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++ended;
    }));
  }
  gate.wait_for_begin();
  EXPECT_EQ(held.use_count(), kTasks + 1);
  gate.open();
  worker.reset();
  EXPECT_EQ(begun, ended);
  EXPECT_LT(ended, kTasks);
  EXPECT_EQ(held.use_count(), 1) << "dropped tasks let go of what they hold";
}

TEST(Worker, RestsOnceAfterItHasWorked) {
  std::atomic<int> rests = 0;
  std::promise<void> first, second;
  {
    Worker worker(
        10, [&] { (++rests == 1 ? first : second).set_value(); }, std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(rests, 0) << "there is nothing to rest from";
    ASSERT_TRUE(worker.submit([] {}));
    first.get_future().wait();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(rests, 1);
    ASSERT_TRUE(worker.submit([] {}));
    second.get_future().wait();
  }
  EXPECT_EQ(rests, 2);
}

TEST(Worker, DoesNotRestWhileThereIsWorkNorAtItsEnd) {
  std::atomic<int> rests = 0;
  std::promise<void> all;
  {
    Worker worker(
        10, [&] { ++rests; }, std::chrono::minutes(10));
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(worker.submit([] {}));
    ASSERT_TRUE(worker.submit([&] { all.set_value(); }));
    all.get_future().wait();
  }
  EXPECT_EQ(rests, 0);
}

TEST(Worker, OneThatHadNothingToDoEnds) { const Worker worker(1); }

}  // namespace
}  // namespace faceprobe::serve
