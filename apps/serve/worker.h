#pragma once
// One thread that does one thing after another: an estimate takes all processors by itself.
//
//   Worker worker(16);
//   if (!worker.submit([] { draw(); })) refuse();

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace faceprobe::serve {

class Worker {
 public:
  // `rest` is called on the thread, once, when nothing has been there to do for `rest_after` since the last task; it does not throw.
  explicit Worker(std::size_t most_waiting, std::function<void()> rest = {}, std::chrono::milliseconds rest_after = {});
  // What runs is finished; what waits is dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // False when too many wait already. Tasks do not throw.
  bool submit(std::function<void()> task);

 private:
  void run();
  // The next task; none at the end.
  std::function<void()> next(bool has_worked);

  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<std::function<void()>> tasks_;
  std::size_t most_waiting_;
  std::function<void()> rest_;
  std::chrono::milliseconds rest_after_;
  bool ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace faceprobe::serve
