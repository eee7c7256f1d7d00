#include "completion.h"

namespace faceprobe::cli {

namespace {

std::string fish_quoted(const std::string& text) { return shell_quoted(text, true); }

// The verbs that are on the command line so far. A value that is called like a verb is taken for one only in the verb's place.
std::string fish_place(const VerbText& program) {
  std::string text = "function __faceprobe_place\n  set -l place faceprobe\n";
  text += "  for word in (commandline -opc)[2..-1]\n    switch \"$place $word\"\n      case";
  for (const VerbText* verb : all_verbs(program)) {
    if (verb->words.size() > 1) text += " \\\n        " + fish_quoted(joined(verb->words));
  }
  text += "\n        set place \"$place $word\"\n    end\n  end\n  echo $place\nend\n";
  return text + "function __faceprobe_at\n  test (__faceprobe_place) = \"$argv\"\nend\n";
}

// -x: a value and no files; -r -F: a value, files too.
std::string fish_values(const OptionText& option) {
  const std::string text = option.path == OnDisk::kFile ? " -r -F" : " -x";
  if (option.path == OnDisk::kFolder) return text + " -a '(__fish_complete_directories)'";
  return option.choices.empty() ? text : text + " -a " + fish_quoted(joined(option.choices));
}

std::string fish_option(const OptionText& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.values != 0) text += fish_values(option);
  return text + " -d " + fish_quoted(option.description);
}

std::string fish_argument(const OptionText& argument) {
  std::string text = " -d " + fish_quoted(argument.names[0]);
  if (argument.path == OnDisk::kFile) text += " -F";
  if (argument.path == OnDisk::kFolder) text += " -a '(__fish_complete_directories)'";
  return argument.choices.empty() ? text : text + " -a " + fish_quoted(joined(argument.choices));
}

}  // namespace

std::string fish_completion(const VerbText& program) {
  std::string text = written_by("fish") + fish_place(program) + "\ncomplete -c faceprobe -f\n";
  for (const VerbText* verb : all_verbs(program)) {
    const std::string at = "complete -c faceprobe -n " + fish_quoted("__faceprobe_at " + joined(verb->words));
    text += "\n";
    for (const VerbText& below : verb->verbs)
      text += at + " -a " + below.words.back() + " -d " + fish_quoted(below.description) + "\n";
    for (const OptionText& option : verb->options) text += at + fish_option(option) + "\n";
    for (const OptionText& argument : verb->arguments) text += at + fish_argument(argument) + "\n";
  }
  return text;
}

}  // namespace faceprobe::cli
