#pragma once
// One thread that does one thing after another: an estimate takes all processors by itself.
//
//   Worker worker(16);
//   if (!worker.submit([] { draw(); })) refuse();

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace faceprobe::serve {

class Worker {
 public:
  explicit Worker(std::size_t most_waiting);
  // What runs is finished; what waits is dropped.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // False when too many wait already. Tasks do not throw.
  bool submit(std::function<void()> task);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<std::function<void()>> tasks_;
  std::size_t most_waiting_;
  bool ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace faceprobe::serve
