#include "option_tree.h"

#include <CLI/CLI.hpp>

#include <sstream>

namespace faceprobe::cli {

namespace {

// "{a,b}|FILE:INT in [0 - 9]" to its parts; what is in braces stays whole.
std::vector<std::string> type_parts(const std::string& type) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : type) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (depth == 0 && (c == ':' || c == '|')) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

void read_type_part(const std::string& part, OptionText& text) {
  const std::size_t bounds = part.find(" in [");
  if (part.size() > 1 && part.front() == '{' && part.back() == '}') {
    text.choices = CLI::detail::split(part.substr(1, part.size() - 2), ',');
  } else if (bounds != std::string::npos && part.back() == ']') {
    text.range = part.substr(bounds + 5, part.size() - bounds - 6);
    if (const std::size_t dash = text.range.find(" - "); dash != std::string::npos) text.range.replace(dash, 3, " to ");
  } else if (part == "POSITIVE") {
    text.range = "above 0";
  } else if (part == "NONNEGATIVE") {
    text.range = "0 or more";
  } else {
    if (part.ends_with("FILE") || part.starts_with("PATH")) text.path = OnDisk::kFile;
    if (part == "DIR") text.path = OnDisk::kFolder;
    // A check says more than the type before it, but "TEXT" and "FILE" need not both be shown.
    if (text.placeholder.empty() || text.placeholder == "TEXT") text.placeholder = part;
  }
}

void read_type(const CLI::Option& option, OptionText& text) {
  for (const std::string& part : type_parts(option.get_type_name())) {
    if (!part.empty()) read_type_part(part, text);
  }
  if (text.choices.empty()) return;
  text.placeholder = text.path == OnDisk::kNothing ? "NAME" : "NAME|" + text.placeholder;
}

OptionText read_option(const CLI::Option& option) {
  OptionText text;
  if (option.get_positional()) {
    text.names = {option.get_single_name()};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  text.description = option.get_description();
  text.required = option.get_required();
  if (option.get_items_expected_max() == 0) return text;
  read_type(option, text);
  text.default_value = option.get_default_str();
  text.values =
      option.get_expected_max() == CLI::detail::expected_max_vector_size ? kAnyNumber : option.get_items_expected_max();
  return text;
}

// Paragraphs of a footer; those that begin with "Example:" or "Examples:" hold commands, each indented by two.
void read_footer(const std::string& footer, VerbText& verb) {
  bool examples = false;
  bool open = false;  // the paragraph or the example goes on
  for (const std::string& line : CLI::detail::split(footer, '\n')) {
    if (line.empty()) {
      examples = open = false;
    } else if (line == "Example:" || line == "Examples:") {
      examples = true;
      open = false;
    } else if (examples) {
      if (!open) verb.examples.emplace_back();
      verb.examples.back().push_back(line.starts_with("  ") ? line.substr(2) : line);
      open = line.ends_with('\\');
    } else {
      if (!open) verb.paragraphs.emplace_back();
      verb.paragraphs.back() += (open ? " " : "") + line;
      open = true;
    }
  }
}

VerbText read_verb(const CLI::App& app, std::vector<std::string> words) {
  VerbText verb;
  verb.words = std::move(words);
  verb.description = app.get_description();
  verb.needs_verb = app.get_require_subcommand_min() > 0;
  // A verb without a footer inherits the program's.
  if (app.get_parent() == nullptr || app.get_footer() != app.get_parent()->get_footer())
    read_footer(app.get_footer(), verb);
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty())  // hidden otherwise
      (option->get_positional() ? verb.arguments : verb.options).push_back(read_option(*option));
  }
  for (const CLI::App* below : app.get_subcommands({})) {
    if (below->get_group().empty() || below->get_name().empty()) continue;
    std::vector<std::string> path = verb.words;
    path.push_back(below->get_name());
    verb.verbs.push_back(read_verb(*below, std::move(path)));
  }
  return verb;
}

void collect(const VerbText& verb, std::vector<const VerbText*>& all) {
  all.push_back(&verb);
  for (const VerbText& below : verb.verbs) collect(below, all);
}

}  // namespace

VerbText read_tree(const CLI::App& program) { return read_verb(program, {program.get_name()}); }

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  return CLI::detail::join(words, separator);
}

std::vector<const VerbText*> all_verbs(const VerbText& program) {
  std::vector<const VerbText*> all;
  collect(program, all);
  return all;
}

}  // namespace faceprobe::cli
