#include "program_light_methods.h"

#include "case_methods.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/eval/case_benchmark.h"
#include "faceprobe/eval/case_export.h"
#include "faceprobe/eval/case_report.h"

#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

using RunFolders = std::map<int, fs::path>;  // by the photo's number

// Metrics of the cases are thrown away here, so the object may be a coarse one.
eval::LitObject coarse_ball() { return eval::LitObject(eval::sphere_mesh(8), {.size_px = 16}); }

eval::LightMethod of_results(const std::string& name, RunFolders folders) {
  return {name,
          [folders = std::move(folders), grid = std::make_shared<const SphereGrid>(eval::RelightBenchmark().nside)](
              const eval::LightInput& input) -> Eigen::MatrixX3f {
            const auto folder = folders.find(input.number);
            if (folder == folders.end()) return {};
            const Image& photo = input.photo.linear;
            const eval::CaseResult result = eval::read_case_result(folder->second, photo.width(), photo.height());
            return result.light ? grid_from_env_map(*result.light, *grid) : Eigen::MatrixX3f();
          }};
}

Error two_methods(const std::string& name) {
  return {ExitCode::kUsage, "There are two methods called '" + name + "'; give the --method another name."};
}

}  // namespace

std::string identity_of_programs(const std::vector<std::string>& methods, int seconds) {
  if (methods.empty()) return {};
  std::string text = std::to_string(seconds) + " s\n";
  std::set<std::string> names;
  for (const std::string& named : methods) {
    const eval::CaseMethod method = program_method(named, seconds);
    if (!names.insert(method.name).second) throw two_methods(method.name);
    text += method.name + '\n' + method.identity;
  }
  return text;
}

ProgramMethods program_light_methods(const synth::ShardReader& faces, const ProgramRows& rows) {
  if (rows.methods.empty()) return {};
  std::vector<eval::CaseMethod> programs;
  for (const std::string& named : rows.methods) {
    programs.push_back(program_method(named, rows.seconds));
    if (rows.taken.contains(programs.back().name)) throw two_methods(programs.back().name);
  }
  const fs::path cases = rows.folder / "cases";
  std::error_code error;
  fs::remove_all(cases, error);  // of other photos
  if (error) throw Error(ExitCode::kOutput, cases.string() + " cannot be emptied: " + error.message() + ".");
  eval::export_cases(faces, cases, {.samples = rows.samples});
  const fs::path work = rows.folder / "programs";
  const eval::CaseScores scores = eval::measure_cases(cases, programs,
                                                      {.work = work,
                                                       .object = coarse_ball,
                                                       .scoring = program_identity(),
                                                       .samples = rows.samples,
                                                       .progress = rows.progress});
  std::map<std::string, RunFolders> folders;
  for (const eval::ScoreRow& run : scores.runs.rows()) {
    if (!run.groups.contains("failure"))
      folders[run.method][std::stoi(run.sample)] = work / run.groups.at("folder") / "out";
  }
  ProgramMethods found{.methods = {},
                       .missing = scores.failures.empty() ? "" : " " + eval::failures_text(scores.failures, "photo")};
  for (const eval::CaseMethod& program : programs)
    found.methods.push_back(of_results(program.name, std::move(folders[program.name])));
  return found;
}

}  // namespace faceprobe::cli
