#include "completion.h"

namespace faceprobe::cli {

namespace {

// In a specification of _arguments a colon ends a part, and a bracket the explanation.
std::string zsh_escaped(const std::string& text, const std::string& special) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || special.find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_function(const VerbText& verb) { return "_" + joined(verb.words, "_"); }

// "message:action" for one value.
std::string zsh_value(const OptionText& option, const std::string& message) {
  std::string text = zsh_escaped(message, ":") + ":";
  const std::string words = "(" + joined(option.choices) + ")";
  if (!option.choices.empty() && option.path != OnDisk::kNothing) {
    return text + "_alternative \"words\\:word\\:" + words + "\" \"files\\:file\\:_files\"";
  }
  if (!option.choices.empty()) return text + words;
  if (option.path != OnDisk::kNothing) return text + (option.path == OnDisk::kFile ? "_files" : "_files -/");
  return text + " ";
}

// One quoted specification for each name, which exclude each other but for options that may come again.
std::string zsh_option(const OptionText& option) {
  std::string text;
  const bool again = option.values == kAnyNumber;
  for (const std::string& name : option.names) {
    std::string spec = again ? "*" : option.names.size() > 1 ? "(" + joined(option.names) + ")" : "";
    spec += name;
    if (option.values != 0) spec += name.starts_with("--") ? "=" : "+";
    spec += "[" + zsh_escaped(option.description, "[]") + "]";
    for (int i = 0; i < (again ? 1 : option.values); ++i) spec += ":" + zsh_value(option, option.placeholder);
    text += "    " + shell_quoted(spec) + " \\\n";
  }
  return text;
}

std::string zsh_argument(const OptionText& argument) {
  const std::string first = argument.values == kAnyNumber ? "*:" : argument.required ? ":" : "::";
  return "    " + shell_quoted(first + zsh_value(argument, argument.names[0])) + " \\\n";
}

std::string zsh_verb(const VerbText& verb) {
  std::string text = "\n" + zsh_function(verb) + "() {\n";
  if (!verb.verbs.empty())
    text += "  local curcontext=$curcontext state state_descr line ret=1\n  typeset -A opt_args\n";
  text += verb.verbs.empty() ? "  _arguments -s -S \\\n" : "  _arguments -s -S -C \\\n";
  for (const OptionText& option : verb.options) text += zsh_option(option);
  for (const OptionText& argument : verb.arguments) text += zsh_argument(argument);
  if (verb.verbs.empty()) {
    text.replace(text.size() - 3, 3, "\n");
    return text + "}\n";
  }
  text += "    ': :->verb' \\\n    '*:: :->rest' && ret=0\n";
  text += "  case $state in\n    verb)\n      local -a verbs=(\n";
  for (const VerbText& below : verb.verbs) {
    text += "        " + shell_quoted(zsh_escaped(below.words.back(), ":") + ":" + below.description) + "\n";
  }
  text += "      )\n      _describe -t verbs verb verbs && ret=0 ;;\n    rest)\n      case $line[1] in\n";
  for (const VerbText& below : verb.verbs) {
    text += "        " + below.words.back() + ") " + zsh_function(below) + " && ret=0 ;;\n";
  }
  return text + "      esac ;;\n  esac\n  return ret\n}\n";
}

}  // namespace

std::string zsh_completion(const VerbText& program) {
  std::string text = "#compdef faceprobe\n" + written_by("zsh");
  for (const VerbText* verb : all_verbs(program)) text += zsh_verb(*verb);
  // Found by its name in $fpath, the file is the function's body when it is first called; sourced, it tells the shell of it.
  text +=
      "\nif [[ $funcstack[1] == _faceprobe ]]; then\n  _faceprobe \"$@\"\nelse\n  compdef _faceprobe faceprobe\nfi\n";
  return text;
}

}  // namespace faceprobe::cli
