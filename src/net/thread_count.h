#pragma once
// oneDNN's number of threads, for as long as this object lives.

namespace faceprobe::net {

// OpenMP's number of threads belongs to the thread that asks, so nobody else sees it changed.
class ThreadCount {
 public:
  explicit ThreadCount(int threads);  // 0 = all processors
  ~ThreadCount();
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_;
};

}  // namespace faceprobe::net
