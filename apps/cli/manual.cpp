#include "manual.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace faceprobe::cli {

namespace {

// As CONVENTIONS.md has them; tests/cli compares.
constexpr std::pair<ExitCode, const char*> kExitCodes[] = {
    {ExitCode::kOk, "done"},
    {ExitCode::kUnexpected, "unexpected: a bug, please report it"},
    {ExitCode::kUsage, "usage: options that do not parse or do not go together"},
    {ExitCode::kInput, "input that cannot be read, or is over a limit"},
    {ExitCode::kNoFace, "the photo holds no usable face"},
    {ExitCode::kModel, "a model file is missing or not what it should be"},
    {ExitCode::kOutput, "the output could not be written"},
    {ExitCode::kDevice, "a device that was asked for is not there"},
    {ExitCode::kBatchFailures, "a batch ran to its end, and some items failed"},
};

std::string escaped(char c, bool literal) {
  switch (c) {
    case '\\': return "\\e";
    case '-': return "\\-";
    case '^': return "\\(ha";
    case '~': return "\\(ti";
    case '"': return "\\(dq";
    case '`': return "\\(ga";
    case '\'': return literal ? "\\(aq" : "'";
    default: return std::string(1, c);
  }
}

// Prose or, where quotes must stay what they are, what is typed. What `stands in such quotes` is bold in prose.
std::string troff(const std::string& text, bool literal = false) {
  std::string out;
  bool bold = false;
  bool line_start = true;
  for (const char c : text) {
    if (line_start && (c == '.' || c == '\'')) out += "\\&";  // it would be a request
    line_start = c == '\n';
    if (c == '`' && !literal) {
      bold = !bold;
      out += bold ? "\\fB" : "\\fR";
    } else {
      out += escaped(c, literal);
    }
  }
  return bold ? out + "\\fR" : out;
}

std::string bold(const std::string& text) { return "\\fB" + troff(text, true) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + troff(text, true) + "\\fR"; }

// "the light of a photo" to "The light of a photo."; a name such as x1,y1 keeps its case.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  const bool word = text.size() > 1 && (std::islower(static_cast<unsigned char>(text[1])) != 0 || text[1] == ' ');
  if (word) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') ? text : text + ".";
}

// What a page's NAME says of a verb: "Faceprobe turns ... ." to "turns ...".
std::string short_description(const VerbText& verb) {
  std::string text = verb.description;
  if (text.starts_with("Faceprobe ")) text.erase(0, 10);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string page_name(const VerbText& verb) { return joined(verb.words, "-"); }
std::string reference(const VerbText& verb) { return bold(page_name(verb)) + "(1)"; }

std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : ".SH " + title + "\n" + body;
}

std::string entry(const std::string& term, const std::string& text) { return ".TP\n" + term + "\n" + text + "\n"; }

std::string value_of(const OptionText& option) {
  std::string text;
  for (int i = 0; i < std::max(1, option.values); ++i) text += " " + italic(option.placeholder);
  return option.values == kAnyNumber ? text + "..." : text;
}

std::string synopsis(const VerbText& verb) {
  std::string text = bold(joined(verb.words)) + " [" + italic("OPTION") + "]...";
  for (const OptionText& option : verb.options) {
    if (option.required) text += " " + bold(option.names.back()) + value_of(option);
  }
  for (const OptionText& argument : verb.arguments) {
    const std::string name = italic(argument.names[0]) + (argument.values == kAnyNumber ? "..." : "");
    text += argument.required ? " " + name : " [" + name + "]";
  }
  if (verb.needs_verb) text += " " + italic("VERB") + " ...";
  return text + "\n";
}

// What an option does, and which values it takes.
std::string option_text(const OptionText& option) {
  std::string text = troff(sentence(option.description));
  if (!option.choices.empty()) {
    text += "\nOne of ";
    for (const std::string& choice : option.choices)
      text += (&choice == option.choices.data() ? "" : ", ") + bold(choice);
    text += option.path == OnDisk::kNothing ? "." : ", or a file.";
  }
  if (!option.range.empty()) text += "\nAllowed: " + troff(option.range) + ".";
  if (!option.default_value.empty()) text += "\nDefault: " + bold(option.default_value) + ".";
  if (option.required) text += "\nRequired.";
  return text;
}

std::string options_text(const std::vector<OptionText>& options) {
  std::string text;
  for (const OptionText& option : options) {
    std::string term;
    for (const std::string& name : option.names) term += (term.empty() ? "" : ", ") + bold(name);
    text += entry(term + (option.values == 0 ? "" : value_of(option)), option_text(option));
  }
  return text;
}

std::string arguments_text(const std::vector<OptionText>& arguments) {
  std::string text;
  for (const OptionText& argument : arguments)
    text += entry(italic(argument.names[0]) + (argument.values == kAnyNumber ? "..." : ""), option_text(argument));
  return text;
}

std::string description(const VerbText& verb) {
  std::string text = troff(sentence(verb.description)) + "\n";
  for (const std::string& paragraph : verb.paragraphs) {
    if (!paragraph.starts_with("Exit codes: ")) text += ".PP\n" + troff(paragraph) + "\n";
  }
  return text;
}

std::string verbs_text(const VerbText& verb) {
  std::string text;
  for (const VerbText& below : verb.verbs) text += entry(reference(below), troff(sentence(below.description)));
  return text;
}

std::string example(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += troff(line, true) + "\n";
  return text;
}

// A verb's own; of the program the first of each verb.
std::string examples(const VerbText& verb) {
  std::string text;
  for (const auto& lines : verb.examples) text += example(lines);
  if (verb.words.size() == 1 && text.empty()) {
    for (const VerbText& below : verb.verbs) {
      if (!below.examples.empty()) text += example(below.examples.front());
    }
  }
  return text.empty() ? "" : ".EX\n" + text + ".EE\n";
}

std::string environment() {
  return entry(bold("FACEPROBE_DATA_DIR"),
               troff("Folder that holds the models, in place of share/faceprobe beside the folder of the command."));
}

std::string exit_status() {
  std::string text;
  for (const auto& [code, meaning] : kExitCodes)
    text += entry(bold(std::to_string(static_cast<int>(code))), troff(sentence(meaning)));
  return text;
}

// Whether the page of `verb` speaks of `other`, as in "folder that `faceprobe synth` wrote".
bool mentions(const VerbText& verb, const VerbText& other) {
  const std::string name = "`" + joined(other.words) + "`";
  const auto has = [&](const OptionText& option) { return option.description.find(name) != std::string::npos; };
  return std::any_of(verb.options.begin(), verb.options.end(), has) ||
         std::any_of(verb.arguments.begin(), verb.arguments.end(), has) ||
         joined(verb.paragraphs).find(name) != std::string::npos;
}

bool begins_with(const std::vector<std::string>& words, const std::vector<std::string>& first) {
  return first.size() <= words.size() && std::equal(first.begin(), first.end(), words.begin());
}

// What is above, what is directly below, and what the page mentions.
std::string see_also(const VerbText& program, const VerbText& verb) {
  std::string text;
  for (const VerbText* other : all_verbs(program)) {
    if (other->words == verb.words) continue;
    const bool child = other->words.size() == verb.words.size() + 1 && begins_with(other->words, verb.words);
    if (child || begins_with(verb.words, other->words) || mentions(verb, *other))
      text += (text.empty() ? "" : ",\n") + reference(*other);
  }
  return text + "\n";
}

}  // namespace

std::string page_file(const VerbText& verb) { return page_name(verb) + ".1"; }

std::string manual_page(const VerbText& program, const VerbText& verb) {
  std::string title = page_name(verb);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = ".\\\" Written by `faceprobe manual`; a change belongs into the command's help.\n";
  text += ".TH " + troff(title) + " 1 \"\" \"faceprobe " + troff(std::string(kVersion)) + "\" \"Faceprobe\"\n";
  text += section("NAME", troff(page_name(verb)) + " \\- " + troff(short_description(verb)) + "\n");
  std::string usage = synopsis(verb);
  for (const VerbText& below : verb.verbs) {
    if (!verb.needs_verb) usage += ".br\n" + synopsis(below);
  }
  text += section("SYNOPSIS", usage);
  text += section("DESCRIPTION", description(verb));
  text += section("VERBS", verbs_text(verb));
  text += section("ARGUMENTS", arguments_text(verb.arguments));
  text += section("OPTIONS", options_text(verb.options));
  text += section("EXAMPLES", examples(verb));
  if (verb.words.size() == 1) text += section("ENVIRONMENT", environment());
  text += section("EXIT STATUS", exit_status());
  text += section("SEE ALSO", see_also(program, verb));
  return text;
}

}  // namespace faceprobe::cli
