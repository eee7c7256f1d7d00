#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "serve/server.h"

#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <thread>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  int port = serve::ServerOptions{}.port;
  std::string folder;
  int threads = 0;
  int max_upload_mb = static_cast<int>(serve::ServerOptions{}.max_upload_bytes >> 20);
  int history = static_cast<int>(serve::StudioOptions{}.history_limit);
  bool open = false;
};

// Where results lie until the server ends.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = fs::temp_directory_path() / "faceprobe-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(ExitCode::kOutput,
                  "No folder could be made in " + fs::temp_directory_path().string() + "; name one with --folder.");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Ctrl-C and a polite kill end the server in order, so that its folder goes. By a handler and not by sigwait: libraries have started threads
// before main, which would take the signal and die of it. Signals are the process's own, so is this one pipe.
int stop_pipe[2] = {-1, -1};

void note_signal(int) {
  const char byte = 0;
  static_cast<void>(!::write(stop_pipe[1], &byte, 1));
}

void catch_stop_signals() {
  if (::pipe2(stop_pipe, O_CLOEXEC) != 0) throw Error(ExitCode::kUnexpected, "No pipe could be opened.");
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // nohup wants to be left alone
  }
}

void wait_for_stop_signal() {
  char byte = 0;
  while (::read(stop_pipe[0], &byte, 1) == -1 && errno == EINTR) {
  }
}

int run(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);  // a page that is closed while it is answered
  catch_stop_signals();
  serve::ServerOptions server_options;
  server_options.port = options.port;
  server_options.max_upload_bytes = static_cast<std::int64_t>(options.max_upload_mb) << 20;
  server_options.page = io::find_data("web/index.html").parent_path();
  server_options.samples = io::find_data("samples");
  server_options.studio.history_limit = static_cast<std::size_t>(options.history);
  server_options.studio.estimate.threads = options.threads;
  server_options.studio.limits.max_file_bytes = server_options.max_upload_bytes;
  std::unique_ptr<TemporaryFolder> temporary;
  if (options.folder.empty()) {
    temporary = std::make_unique<TemporaryFolder>();
    server_options.studio.folder = temporary->path();
  } else {
    io::create_folder(options.folder);
    server_options.studio.folder = options.folder;
    server_options.studio.keep = true;
  }
  if (server_options.page.empty()) spdlog::warn("the page was not built; the API alone is served");
  serve::Server server(std::move(server_options));
  const std::string address = "http://127.0.0.1:" + std::to_string(server.port()) + "/";
  std::printf("%s\n", address.c_str());
  std::fflush(stdout);
  spdlog::info("open {} in a browser; Ctrl-C ends", address);
  if (options.open && std::system(("xdg-open " + address + " >/dev/null 2>&1 &").c_str()) != 0)
    spdlog::warn("no browser could be started");
  std::thread listener([&] {
    wait_for_stop_signal();
    server.stop();
  });
  try {
    server.run();
  } catch (...) {
    note_signal(0);  // nobody else wakes the listener
    listener.join();
    throw;
  }
  listener.join();
  return 0;
}

}  // namespace

void add_serve(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("serve", "a page in the browser for all of this, on this machine alone");
  command->add_option("--port", options->port, "of 127.0.0.1; 0: any that is free")->capture_default_str();
  command->add_flag("--open", options->open, "start the browser");
  command
      ->add_option("--folder", options->folder, "keep the results here; default: a temporary folder, gone at the end")
      ->type_name("DIR");
  command->add_option("--max-upload", options->max_upload_mb, "megabytes of a photo's file")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  command->add_option("--history", options->history, "estimates that are remembered")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--threads", options->threads, "processors to use; 0: all")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->footer(
      "The address is printed on stdout. Nothing is sent anywhere else; other machines cannot connect.\n\n"
      "Examples:\n  faceprobe serve --open\n  faceprobe serve --port 0 --folder results");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
