#pragma once
// How far a long job is, with the time left, on stderr; nothing where that is no terminal.
//
//   Progress progress("drawing");
//   while (work()) progress.show(share);     // 0..1
//   progress.end();

#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <string>
#include <utility>

namespace faceprobe::cli {

class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {}

  // Always true: for callbacks that may stop a job.
  bool show(float share) {
    const double seconds = since_start();
    if (!terminal_ || seconds < shown_ + 0.2) return true;
    shown_ = seconds;
    std::fprintf(stderr, "\r%s: %3.0f %%, %.0f s left   ", what_.c_str(), 100.0 * static_cast<double>(share),
                 share > 0 ? seconds * (1 / static_cast<double>(share) - 1) : 0);
    std::fflush(stderr);
    return true;
  }

  void end() {
    if (terminal_ && shown_ > 0) std::fputs("\r\033[K", stderr);
  }

 private:
  double since_start() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::string what_;
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  double shown_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace faceprobe::cli
