#pragma once
// Another program, run without a shell: what stands in its words is never read as a command.
//
//   const std::string failure = run_program({"python3", "mine.py", "cases/0001"}, "log.txt", 120);
//   if (!failure.empty()) ...                                        // "exit code 3"
//
// It runs with the rights of whoever runs this command: no sandbox.

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::cli {

// Waits for the end. The first word is looked for on the PATH when it has no slash. stdin is empty; stdout and stderr go into `log`. Returns why it did
// not end well, or nothing. After `limit_s` seconds, 16 MiB of log, or a signal that ends this command, the program ends too, and in any case what it
// started and left behind. Throws Error(kUsage) when it cannot be started, Error(kOutput) when the log cannot be written.
std::string run_program(const std::vector<std::string>& words, const std::filesystem::path& log, int limit_s);

}  // namespace faceprobe::cli
