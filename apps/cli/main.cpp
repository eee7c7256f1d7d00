// faceprobe: turns the faces of a photo into the light that fell on them.

#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <malloc.h>
#include <csignal>
#include <cstdio>
#include <string>

namespace {

// A program that is started with stdout or stderr closed would open its first output file under that number, and its log would go
// into the file. What is opened in their place refuses writing, so that lost data is still noticed.
void occupy_standard_streams() {
  for (int stream = 0; stream <= 2; ++stream) {
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
  }
}

// A report that did not arrive is a failure, however well the photos went.
int with_stdout_written(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  throw faceprobe::Error(faceprobe::ExitCode::kOutput,
                         "The standard output cannot be written: it is closed, or its disk is full.");
}

}  // namespace

int main(int argc, char** argv) {
  namespace cli = faceprobe::cli;
  occupy_standard_streams();
  // Pictures and matrices come and go, in a set of faces by the thousand: memory given back to the system in between would be cleared and
  // mapped again each time, a tenth of synth's time and more of a solve's.
  mallopt(M_MMAP_THRESHOLD, 256 << 20);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  std::signal(SIGPIPE, SIG_DFL);  // `faceprobe ... | head` ends quietly
  spdlog::set_default_logger(spdlog::stderr_color_st("faceprobe"));
  spdlog::set_pattern("%^%l%$: %v");

  CLI::App program("Faceprobe turns the faces of an ordinary photo into the light that fell on them.", "faceprobe");
  program.set_version_flag("--version", std::string(faceprobe::kVersion));
  program.require_subcommand(1);
  bool quiet = false;
  program.add_flag("-q,--quiet", quiet, "errors only on stderr");
  program.fallthrough();
  program.footer(
      "Exit codes: 0 ok, 1 unexpected, 2 usage, 3 input unreadable or over a limit, 4 no usable face, 5 model missing "
      "or\n"
      "invalid, 6 output not written, 7 device unavailable, 8 some of several photos failed.");
  cli::Action action;
#ifndef FACEPROBE_LEAN
  cli::add_estimate(program, action);
  cli::add_separate(program, action);
  cli::add_triangulate(program, action);
  cli::add_relight(program, action);
  cli::add_insert(program, action);
  cli::add_info(program, action);
  cli::add_doctor(program, action);
  cli::add_manual(program, action);
  cli::add_completion(program, action);
#endif
#ifdef FACEPROBE_HAS_SERVE
  cli::add_serve(program, action);
#endif
#ifdef FACEPROBE_HAS_SYNTH
  cli::add_synth(program, action);
  cli::add_mesh(program, action);
#ifndef FACEPROBE_LEAN
  cli::add_trace(program, action);
#endif
#endif
#ifdef FACEPROBE_HAS_TRAIN
  cli::add_train(program, action);
#ifndef FACEPROBE_LEAN
  cli::add_finetune(program, action);
  cli::add_finetune_surface(program, action);
  cli::add_eval(program, action);
#endif
#endif
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 numbers its errors from 100; help and version are no errors.
    return program.exit(error) == 0 ? 0 : static_cast<int>(faceprobe::ExitCode::kUsage);
  }
  if (quiet) spdlog::set_level(spdlog::level::err);
  return cli::run_guarded([&action] { return with_stdout_written(action()); });
}
