#include "commands.h"
#include "faceprobe/core/version.h"
#include "faceprobe/pipeline/self_test.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace faceprobe::cli {

namespace {

int run(bool json) {
  const std::vector<pipeline::Check> checks = pipeline::self_test();
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
  CLI::App* command =
      program.add_subcommand("doctor", "whether this installation works: models, a known light, the renderer");
  command->add_flag("--json", *json, "the same as JSON");
  command->footer(
      "A line for each check, ok or FAIL; the exit code is that of the first one that failed.\n\n"
      "Example:\n  faceprobe doctor");
  command->callback([json, &action] { action = [json] { return run(*json); }; });
}

}  // namespace faceprobe::cli
