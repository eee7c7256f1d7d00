#include "run_program.h"

#include "faceprobe/core/error.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to the program

namespace faceprobe::cli {

namespace {

constexpr off_t kMostLogBytes = 16 << 20;

// The program's process group. It is another than ours, so that the program ends with all it started; a Ctrl-C has to be passed on, therefore.
std::atomic<pid_t> running_group = 0;
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler reads it");

void end_group_and_us(int signal) {
  if (const pid_t group = running_group; group > 0) ::kill(-group, SIGKILL);
  ::raise(signal);  // the handler is reset: the signal does what it would have done
}

// Passes the signals that end us on to the program.
class SignalsPassedOn {
 public:
  SignalsPassedOn() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      struct sigaction action {};
      ::sigaction(kSignals[i], nullptr, &old_[i]);
      if (old_[i].sa_handler == SIG_IGN) continue;  // as under nohup
      action.sa_handler = end_group_and_us;
      action.sa_flags = static_cast<int>(SA_RESETHAND);
      ::sigaction(kSignals[i], &action, nullptr);
    }
  }
  SignalsPassedOn(const SignalsPassedOn&) = delete;
  SignalsPassedOn& operator=(const SignalsPassedOn&) = delete;
  ~SignalsPassedOn() {
    running_group = 0;
    for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &old_[i], nullptr);
  }

 private:
  static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> old_{};
};

class LogFile {
 public:
  explicit LogFile(const std::filesystem::path& path)
      : fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666)) {
    if (fd_ < 0) {
      throw Error(ExitCode::kOutput,
                  path.string() + " cannot be written: " + std::generic_category().message(errno) + ".");
    }
  }
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;
  ~LogFile() { ::close(fd_); }

  int fd() const { return fd_; }
  bool too_long() const {
    struct stat status {};
    return ::fstat(fd_, &status) == 0 && status.st_size > kMostLogBytes;
  }

 private:
  int fd_;
};

pid_t start(const std::vector<std::string>& words, const LogFile& log) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, log.fd(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, log.fd(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t pid = 0;
  const int fault = ::posix_spawnp(&pid, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (fault != 0) {
    throw Error(ExitCode::kUsage, "The program " + words[0] +
                                      " cannot be started: " + std::generic_category().message(fault) +
                                      ". Check its name, the PATH, and the interpreter that it names.");
  }
  return pid;
}

// Until it has ended, or must. Does not take the end away: the number of the process stays its own until then.
std::string wait_for(pid_t pid, const LogFile& log, int limit_s) {
  using namespace std::chrono;  // NOLINT(google-build-using-namespace): literals of time
  const auto deadline = steady_clock::now() + seconds(limit_s);
  auto pause = milliseconds(1);
  while (true) {
    siginfo_t end{};
    const int fault = ::waitid(P_PID, static_cast<id_t>(pid), &end, WEXITED | WNOWAIT | WNOHANG);
    if (fault == 0 && end.si_pid == pid) return {};
    if (steady_clock::now() >= deadline) return "over the limit of " + std::to_string(limit_s) + " s";
    if (log.too_long()) return "more than " + std::to_string(kMostLogBytes >> 20) + " MiB of log";
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, milliseconds(20));
  }
}

}  // namespace

std::string run_program(const std::vector<std::string>& words, const std::filesystem::path& log_path, int limit_s) {
  const LogFile log(log_path);
  const SignalsPassedOn signals;
  const pid_t pid = start(words, log);
  running_group = pid;
  std::string failure = wait_for(pid, log, limit_s);
  ::kill(-pid, SIGKILL);  // what it left behind, too
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!failure.empty()) return failure;
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? std::string() : "exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace faceprobe::cli
