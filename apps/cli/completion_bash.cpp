#include "completion.h"

namespace faceprobe::cli {

namespace {

// The part that is the same for every program. _faceprobe_verb, _faceprobe_option and _faceprobe_argument fill the variables of _faceprobe.
constexpr const char* kBashEngine = R"sh(
_faceprobe() {
  local current=${COMP_WORDS[COMP_CWORD]} verb=faceprobe place=0 prefix= word i
  local takes=0 words= paths= options= verbs=
  # A readline that breaks words at "=" hands over the value of --option=value alone.
  if [[ $current == = ]]; then current=; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == = ]]; then continue; fi
    if ((takes > 0)); then takes=$((takes - 1)); continue; fi
    if ((takes < 0)) && [[ $word != -* ]]; then continue; fi
    if [[ $word == -* ]]; then
      _faceprobe_option "$verb" "$word"
      continue
    fi
    _faceprobe_verb "$verb"
    if ((place == 0)) && [[ " $verbs " == *" $word "* ]]; then verb+=" $word"; else place=$((place + 1)); fi
  done
  if [[ $current == --*=* ]]; then
    prefix=${current%%=*}=
    _faceprobe_option "$verb" "${current%%=*}"
    current=${current#*=}
  elif ((takes <= 0)) && [[ $current == -* ]]; then
    _faceprobe_verb "$verb"
    words=$options paths=
  elif ((takes == 0)); then
    _faceprobe_verb "$verb"
    _faceprobe_argument "$verb" "$place"
    if ((place == 0)); then words="$verbs $words"; fi
  fi
  COMPREPLY=()
  if [[ $words ]]; then mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$words" -- "$current"); fi
  if [[ $paths ]]; then
    # Outside a completion, as in a test, there is nothing to set.
    compopt -o filenames 2>/dev/null || true
    local kind=-f
    if [[ $paths == folder ]]; then kind=-d; fi
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -P "$prefix" "$kind" -- "$current")
  fi
}
complete -F _faceprobe faceprobe
)sh";

// "words='a b' paths=file": what may stand there.
std::string bash_values(const OptionText& option) {
  std::string text;
  if (!option.choices.empty()) text += " words=" + shell_quoted(joined(option.choices));
  if (option.path != OnDisk::kNothing) text += option.path == OnDisk::kFile ? " paths=file" : " paths=folder";
  return text;
}

std::string bash_verbs(const VerbText& program) {
  std::string text = "\n# The verbs and options below a verb.\n_faceprobe_verb() {\n  verbs= options=\n  case $1 in\n";
  for (const VerbText* verb : all_verbs(program)) {
    std::vector<std::string> below, options;
    for (const VerbText& other : verb->verbs) below.push_back(other.words.back());
    for (const OptionText& option : verb->options)
      options.insert(options.end(), option.names.begin(), option.names.end());
    text += "    " + shell_quoted(joined(verb->words)) + ")";
    if (!below.empty()) text += " verbs=" + shell_quoted(joined(below));
    text += " options=" + shell_quoted(joined(options)) + " ;;\n";
  }
  return text + "  esac\n}\n";
}

std::string bash_options(const VerbText& program) {
  std::string text =
      "\n# How many values an option of a verb takes, -1 for any number, and which words or paths they are.\n"
      "_faceprobe_option() {\n  takes=0 words= paths=\n  case \"$1 $2\" in\n";
  for (const VerbText* verb : all_verbs(program)) {
    for (const OptionText& option : verb->options) {
      if (option.values == 0) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(shell_quoted(joined(verb->words) + " " + name));
      text +=
          "    " + joined(patterns, " | ") + ") takes=" + std::to_string(option.values) + bash_values(option) + " ;;\n";
    }
  }
  return text + "  esac\n}\n";
}

std::string bash_arguments(const VerbText& program) {
  std::string text =
      "\n# Which words or paths an argument of a verb is; the first has place 0.\n"
      "_faceprobe_argument() {\n  words= paths=\n  case $1:$2 in\n";
  for (const VerbText* verb : all_verbs(program)) {
    std::size_t place = 0;
    for (const OptionText& argument : verb->arguments) {
      const std::string values = bash_values(argument);
      const bool last = argument.values == kAnyNumber;
      std::string pattern = shell_quoted(joined(verb->words) + ":" + (last ? "" : std::to_string(place)));
      pattern += last ? "*)" : ")";
      if (!values.empty()) text.append("    ").append(pattern).append(values).append(" ;;\n");
      ++place;
    }
  }
  return text + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const VerbText& program) {
  return written_by("bash") + bash_verbs(program) + bash_options(program) + bash_arguments(program) + kBashEngine;
}

}  // namespace faceprobe::cli
