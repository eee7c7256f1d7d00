#pragma once
// The one exception type that leaves the library. It carries the exit code a command should end with, so that a program
// and a script tell "no face in this photo" from "this file is broken" without reading the text. The text is one
// sentence for the person at the keyboard: what was found, what is allowed, what to do.
//
// Not for our own bugs: those are assertions.
//
//   try {
//     const io::Photo photo = io::load_photo("portrait.jpg");
//   } catch (const Error& error) {
//     std::cerr << error.what() << '\n';
//     return static_cast<int>(error.code());
//   }

#include <stdexcept>
#include <string>
#include <vector>

namespace faceprobe {

// Exit codes of the command line; part of the contract with scripts.
enum class ExitCode : int {
  kOk = 0,
  kUnexpected = 1,     // a bug, or a library below failed in a way we did not foresee
  kUsage = 2,          // options that do not parse or do not go together
  kInput = 3,          // a file that cannot be read, or is over a limit
  kNoFace = 4,         // the photo is fine, but holds no usable face
  kModel = 5,          // a model file is missing or not the one it claims to be
  kOutput = 6,         // a result could not be written
  kDevice = 7,         // an explicitly named device is not there
  kBatchFailures = 8,  // a batch ran to its end, some items failed
};

class Error : public std::runtime_error {
 public:
  // `sentence`: what was found, what is allowed, what to do.
  Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  ExitCode code() const noexcept { return code_; }

 private:
  ExitCode code_;
};

// "a, b, c": for sentences that say what there is.
inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace faceprobe
