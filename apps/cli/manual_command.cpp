#include "commands.h"
#include "completion.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "manual.h"
#include "option_tree.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct ManualOptions {
  std::vector<std::string> words;
  std::string folder;
};

std::string names_of(const std::vector<VerbText>& verbs) {
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const VerbText& verb : verbs) names.push_back(verb.words.back());
  return joined(names, ", ");
}

const VerbText& verb_named(const VerbText& program, const std::vector<std::string>& words) {
  const VerbText* verb = &program;
  for (const std::string& word : words) {
    const auto below = std::find_if(verb->verbs.begin(), verb->verbs.end(),
                                    [&](const VerbText& other) { return other.words.back() == word; });
    if (below == verb->verbs.end()) {
      throw Error(ExitCode::kUsage,
                  "There is no verb '" + word + "' of " + joined(verb->words) +
                      (verb->verbs.empty() ? ", which has none." : "; take one of " + names_of(verb->verbs) + "."));
    }
    verb = &*below;
  }
  return *verb;
}

int print_manual(const CLI::App& app, const ManualOptions& options) {
  const VerbText program = read_tree(app);
  if (options.folder.empty()) {
    std::fputs(manual_page(program, verb_named(program, options.words)).c_str(), stdout);
    return 0;
  }
  if (!options.words.empty())
    throw Error(ExitCode::kUsage, "--folder takes the pages of all verbs; leave out '" + joined(options.words) + "'.");
  const std::filesystem::path folder = options.folder;
  io::create_folder(folder);
  const std::vector<const VerbText*> verbs = all_verbs(program);
  for (const VerbText* verb : verbs) io::write_file_atomically(folder / page_file(*verb), manual_page(program, *verb));
  spdlog::info("wrote {} pages to {}", verbs.size(), options.folder);
  return 0;
}

int print_completion(const CLI::App& app, const std::string& shell) {
  const VerbText program = read_tree(app);
  const std::string text = shell == "bash"  ? bash_completion(program)
                           : shell == "zsh" ? zsh_completion(program)
                                            : fish_completion(program);
  std::fputs(text.c_str(), stdout);
  return 0;
}

// The names of all verbs, for completion; asked once all of them are there.
std::string verb_choices(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : program.get_subcommands({})) {
    names.push_back(verb->get_name());
    for (const CLI::App* below : verb->get_subcommands({})) names.push_back(below->get_name());
  }
  return "{" + joined(names, ",") + "}";
}

}  // namespace

void add_manual(CLI::App& program, Action& action) {
  auto options = std::make_shared<ManualOptions>();
  CLI::App* command = program.add_subcommand("manual", "the pages of this command for man, as troff");
  command->add_option("VERB", options->words, "whose page to print; default: the program's")->type_name_fn([&program] {
    return verb_choices(program);
  });
  command->add_option("--folder", options->folder, "write the pages of all verbs into it; default: one is printed")
      ->type_name("DIR");
  command->footer(
      "Examples:\n  faceprobe manual estimate | man -l -\n"
      "  faceprobe manual --folder ~/.local/share/man/man1");
  command->callback(
      [options, &program, &action] { action = [options, &program] { return print_manual(program, *options); }; });
}

void add_completion(CLI::App& program, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("completion", "a script that completes this command's line in a shell");
  command->add_option("SHELL", *shell, "which shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer(
      "For one session, source it; for all, write it where the shell looks for completions.\n\nExamples:\n"
      "  source <(faceprobe completion bash)\n"
      "  faceprobe completion bash > ~/.local/share/bash-completion/completions/faceprobe\n"
      "  faceprobe completion fish > ~/.config/fish/completions/faceprobe.fish\n"
      "  faceprobe completion zsh > ~/.zfunc/_faceprobe");
  command->callback(
      [shell, &program, &action] { action = [shell, &program] { return print_completion(program, *shell); }; });
}

}  // namespace faceprobe::cli
