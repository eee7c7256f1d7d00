#include "serve/worker.h"

#include <utility>

namespace faceprobe::serve {

Worker::Worker(std::size_t most_waiting, std::function<void()> rest, std::chrono::milliseconds rest_after)
    : most_waiting_(most_waiting), rest_(std::move(rest)), rest_after_(rest_after), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  change_.notify_all();
  thread_.join();
}

bool Worker::submit(std::function<void()> task) {
  {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() >= most_waiting_) return false;
    tasks_.push_back(std::move(task));
  }
  change_.notify_all();
  return true;
}

std::function<void()> Worker::next(bool has_worked) {
  const auto something = [this] { return ending_ || !tasks_.empty(); };
  std::unique_lock lock(mutex_);
  if (has_worked && rest_ && !change_.wait_for(lock, rest_after_, something)) {
    lock.unlock();
    rest_();
    lock.lock();
  }
  change_.wait(lock, something);
  if (ending_) return {};
  std::function<void()> task = std::move(tasks_.front());
  tasks_.pop_front();
  return task;
}

void Worker::run() {
  // A task lets go of what it holds before the next one is waited for.
  for (bool has_worked = false;; has_worked = true) {
    const std::function<void()> task = next(has_worked);
    if (!task) return;
    task();
  }
}

}  // namespace faceprobe::serve
