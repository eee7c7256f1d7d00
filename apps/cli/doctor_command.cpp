#include "commands.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/pipeline/self_test.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <utility>

namespace faceprobe::cli {

namespace {

// What is part of this build, and may be there or not.
std::string parts() {
  std::string text = "estimate, separate, insert, relight, triangulate";
#ifdef FACEPROBE_HAS_SERVE
  text += ", serve";
#endif
#ifdef FACEPROBE_HAS_SYNTH
  text += ", synth";
#endif
#ifdef FACEPROBE_HAS_TRAIN
  text += ", train, eval";
#endif
  return text;
}

#ifdef FACEPROBE_HAS_SERVE
// Without it serve works all the same, for programs: no failure.
std::string page() {
  const std::filesystem::path page = io::find_data("web/index.html");
  return page.empty() ? "not installed: serve answers programs alone" : page.string();
}
#endif

int run(bool json) {
  std::vector<pipeline::Check> checks = {{"version", true, std::string(kVersion) + ", with " + parts()}};
#ifdef FACEPROBE_HAS_SERVE
  checks.push_back({"page", true, page()});
#endif
  for (pipeline::Check& check : pipeline::self_test()) checks.push_back(std::move(check));
  int code = 0;
  nlohmann::ordered_json out = {
      {"schema", "faceprobe-doctor/1"}, {"version", kVersion}, {"checks", nlohmann::ordered_json::array()}};
  for (const pipeline::Check& check : checks) {
    if (!check.ok && code == 0) code = static_cast<int>(check.code);
    out["checks"].push_back({{"name", check.name}, {"ok", check.ok}, {"detail", check.detail}});
    if (!json) std::printf("%-4s %s: %s\n", check.ok ? "ok" : "FAIL", check.name.c_str(), check.detail.c_str());
  }
  out["ok"] = code == 0;
  if (json) std::printf("%s\n", out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  return code;
}

}  // namespace

void add_doctor(CLI::App& program, Action& action) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand(
      "doctor", "whether this installation works: its parts, the models, a known light, the renderer");
  command->add_flag("--json", *json, "the same as JSON");
  command->footer(
      "A line for each check, ok or FAIL; the exit code is that of the first one that failed.\n\n"
      "Example:\n  faceprobe doctor");
  command->callback([json, &action] { action = [json] { return run(*json); }; });
}

}  // namespace faceprobe::cli
