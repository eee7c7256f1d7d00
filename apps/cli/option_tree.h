#pragma once
// The program's verbs and options as plain text, read from the parser once all verbs are there: what manual pages and shell
// completions are written from, so that neither can know an option that the parser does not.
//
//   const VerbText program = read_tree(app);
//   program.verbs[0].words;      // {"faceprobe", "estimate"}
//
// What an option takes is in the name of its type (CLI::Option::type_name), which --help shows as well: FILE, DIR or PATH (either) for
// what is on the disk, {net,mesh} for words, {cube,pot}|FILE for both; what a CLI::Validator adds behind a colon is read the same way.

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): theirs
class App;
}

namespace faceprobe::cli {

enum class OnDisk { kNothing, kFile, kFolder };

inline constexpr int kAnyNumber = -1;

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; of an argument its one name, "PHOTO"
  std::string description;
  std::string placeholder;           // "FILE" of "--map FILE"; empty for a flag
  std::string default_value;         // empty: none, or the description tells
  std::string range;                 // "0 to 1024"; empty: free
  std::vector<std::string> choices;  // words that it takes; no others, unless it takes a path too
  OnDisk path = OnDisk::kNothing;
  int values = 0;  // that follow it; 0 for a flag
  bool required = false;
};

struct VerbText {
  std::vector<std::string> words;  // of the program alone its name
  std::string description;
  std::vector<std::string> paragraphs;             // of the footer, but for the examples
  std::vector<std::vector<std::string>> examples;  // lines of each; all but the last end in a backslash
  std::vector<OptionText> options, arguments;      // arguments: by place, as PHOTO
  std::vector<VerbText> verbs;
  bool needs_verb = false;
};

VerbText read_tree(const CLI::App& program);

// "faceprobe synth unwrap", or with another separator.
std::string joined(const std::vector<std::string>& words, const std::string& separator = " ");
// The program and all that is below it, in the order of --help.
std::vector<const VerbText*> all_verbs(const VerbText& program);

}  // namespace faceprobe::cli
