#pragma once
// How far a long job is and how long it will still take, on stderr: a line that writes over itself on a terminal, one every half minute
// elsewhere, such as in a log.
//
//   Progress progress;
//   while (work()) progress.show(done, total, fmt::format("{} of {} shards", done, total));   // "3 of 10 shards, 40 s left"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace faceprobe::cli {

class Progress {
 public:
  Progress() = default;
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  // When all is done the line goes: what came of the job is for the caller to say.
  void show(double done, double total, const std::string& text) {
    if (!running_ ||
        done < last_) {  // another job begins, or one goes on where it was: only what is done from here on tells how fast it is
      begin_s_ = seconds();
      begin_ = done;
    }
    last_ = done;
    running_ = done < total;
    if (!running_) {
      clear();
      return;
    }
    const double now = seconds();
    if (now < shown_s_ + (terminal_ ? kOnTerminalSeconds : kInLogSeconds)) return;
    shown_s_ = now;
    if (terminal_) {
      fmt::print(stderr, "\r\033[K{}{}", text, left(done, total));
    } else {
      spdlog::info("{}{}", text, left(done, total));
    }
  }

  // For a job that may end before all is done.
  void clear() {
    if (terminal_ && shown_s_ > 0) fmt::print(stderr, "\r\033[K");
    shown_s_ = 0;
  }

  // Since this was made.
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  static constexpr double kOnTerminalSeconds = 0.2;
  static constexpr double kInLogSeconds = 30;

  std::string left(double done, double total) const {
    if (!(done > begin_)) return {};
    const double left_s = (seconds() - begin_s_) * (total - done) / (done - begin_);
    return left_s < 100 ? fmt::format(", {:.0f} s left", left_s) : fmt::format(", {:.0f} min left", left_s / 60);
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool terminal_ = isatty(STDERR_FILENO) != 0 && spdlog::should_log(spdlog::level::info);  // not with --quiet
  double shown_s_ = 0;  // when the line was written; 0 = there is none
  bool running_ = false;
  double last_ = 0;     // of what was done
  double begin_s_ = 0;  // when the job began,
  double begin_ = 0;    // and what was done then
};

}  // namespace faceprobe::cli
