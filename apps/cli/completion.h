#pragma once
// Scripts that complete the command line in bash, zsh and fish, written from the verbs and options themselves: verbs, options, the words
// that an option takes where they are few, files and folders where it takes a path.
//
//   std::fputs(bash_completion(read_tree(app)).c_str(), stdout);

#include "option_tree.h"

#include <string>

namespace faceprobe::cli {

std::string bash_completion(const VerbText& program);
std::string zsh_completion(const VerbText& program);
std::string fish_completion(const VerbText& program);

// As one word that the shell takes literally; `fish`: whose quotes know an escaped quote.
std::string shell_quoted(const std::string& text, bool fish = false);
// First line of a script, a comment behind what the shell wants there.
std::string written_by(const std::string& shell);

}  // namespace faceprobe::cli
