#include "case_methods.h"
#include "eval_stages.h"
#include "faceprobe/assets/object.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"
#include "faceprobe/eval/case_benchmark.h"
#include "faceprobe/eval/case_export.h"
#include "faceprobe/eval/case_report.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "scene_table.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <set>
#include <string>

namespace faceprobe::cli {

namespace {

void require_output(const EvalOptions& options, const char* what) {
  if (options.output.empty())
    throw Error(ExitCode::kUsage, "eval " + options.stage + " writes " + what + "; name a folder for them with -o.");
}

std::vector<eval::CaseMethod> case_methods(const EvalOptions& options) {
  std::vector<eval::CaseMethod> methods;
  if (options.weights.empty()) methods.push_back(own_method({.prior = options.prior, .threads = options.threads}));
  for (const std::string& named : options.weights) {
    const auto [name, file] = name_and_file(named);
    methods.push_back(own_method({.name = name, .weights = file, .prior = options.prior, .threads = options.threads}));
  }
  methods.push_back(eval::ambient_case_method());
  for (const std::string& named : options.methods) methods.push_back(program_method(named, options.seconds));
  std::set<std::string> names;
  for (const eval::CaseMethod& method : methods) {
    if (!names.insert(method.name).second)
      throw Error(ExitCode::kUsage, "There are two methods called '" + method.name + "'; give one another name.");
  }
  return methods;
}

std::set<std::string> own_names(const EvalOptions& options) {
  if (options.weights.empty()) return {OwnMethod().name};
  std::set<std::string> names;
  for (const std::string& named : options.weights) names.insert(name_and_file(named).first);
  return names;
}

void print_metric(const eval::ScoreTable& table, const std::string& title, const std::string& metric, int decimals) {
  if (!table.known_values(metric).empty()) fmt::print("\n### {}\n\n{}", title, table.markdown(metric, decimals));
}

void print_by_groups(const eval::ScoreTable& table, const std::string& title, const std::string& metric, int decimals) {
  for (const std::string& group : table.groups()) {
    if (group == "failure" || table.labels(group).size() < 2) continue;
    fmt::print("\n### {} by {}\n\n{}", title, group, table.markdown_by_group(metric, group, decimals));
  }
}

void write_table(const std::filesystem::path& folder, const std::string& name, const eval::ScoreTable& table) {
  if (table.rows().empty()) return;
  io::write_file_atomically(folder / (name + ".csv"), table.csv());
  io::write_file_atomically(folder / (name + ".json"), table.json());
}

}  // namespace

int eval_cases(const EvalOptions& options) {
  require_output(options, "results");
  const std::vector<eval::CaseMethod> methods = case_methods(options);
  const std::filesystem::path folder = options.output;
  const synth::SurfaceMesh mesh = options.object.empty() ? eval::sphere_mesh() : assets::load_object(options.object);
  const auto object = [&] { return eval::LitObject(mesh, {.threads = options.threads}); };
  const eval::CaseScores scores = eval::measure_cases(options.data, methods,
                                                      {.work = folder / "cache",
                                                       .object = object,
                                                       .scoring = program_identity() + identity_of_file(options.object),
                                                       .samples = options.samples,
                                                       .progress = eval_progress()});
  fmt::print("{} of {} cases of {}.\n", scores.cases, scores.known, options.data);
  print_metric(scores.light, "Diffuse object, RMSE of 255", "diffuse", 1);
  print_metric(scores.light, "Glossy object, RMSE of 255", "glossy", 1);
  print_by_groups(scores.light, "Glossy object", "glossy", 1);
  print_metric(scores.light, "Main light, degrees, of cases that one lamp dominates", "main_light", 1);
  print_metric(scores.light, "Colour of all the light, degrees", "colour", 2);
  print_metric(scores.light, "Diffuse sphere, error after the best scale", "si_diffuse", 3);
  print_metric(scores.light, "Rough metal sphere, the same", "si_matte", 3);
  print_metric(scores.light, "Mirror sphere, the same", "si_mirror", 3);
  print_metric(scores.light, "Map, error over the true one's range", "nrmse_map_truth", 3);
  print_metric(scores.highlight, "Highlight layer where it is judged, RMSE of 255", "rmse", 2);
  print_metric(scores.highlight, "Its SSIM", "ssim", 3);
  print_by_groups(scores.highlight, "Highlight layer, RMSE", "rmse", 2);
  print_metric(scores.runs, "Seconds a case", "seconds", 2);
  if (!scores.failures.empty()) {
    fmt::print("\n### Missing, and what the methods said is in log.txt of the folder\n\n{}", scores.missing_markdown());
    spdlog::warn("{} of {} results are missing", scores.failures.size(), scores.runs.rows().size());
  }
  const std::string data_name = std::filesystem::absolute(options.data).lexically_normal().filename().string();
  const eval::PaperReport report =
      eval::case_report(scores, {.data = options.data,
                                 .work = folder / "cache",
                                 .made_with = fmt::format("Faceprobe {}. {} of {} cases{}.", kVersion, scores.cases,
                                                          scores.known, data_name.empty() ? "" : " of " + data_name),
                                 .ours = own_names(options),
                                 .object = options.object.empty() ? "A sphere" : "An object",
                                 .draw = object,
                                 .rows = options.rows});
  io::write_file_atomically(folder / "cases.html", eval::report_html(report));
  write_table(folder, "cases_light", scores.light);
  write_table(folder, "cases_highlight", scores.highlight);
  // Every run has a folder of its own: as groups of a JSON these would be as many summaries.
  io::write_file_atomically(folder / "cases_runs.csv", scores.runs.csv());
  return 0;
}

int eval_export_cases(const EvalOptions& options) {
  require_output(options, "case folders");
  const synth::ShardReader faces(options.data);
  eval::CaseExport wanted{.samples = options.samples, .progress = eval_progress()};
  if (!options.scenes.empty()) wanted.scene = scene_of_maps(options.scenes, faces.recipe());
  const std::filesystem::path card = std::filesystem::path(options.data) / "CARD.md";
  if (std::filesystem::exists(card)) wanted.licence = "see CARD.md beside the case folders";
  const int written = eval::export_cases(faces, options.output, wanted);
  if (std::filesystem::exists(card)) {
    const std::vector<std::byte> text = io::read_file(card, 1 << 20);
    io::write_file_atomically(std::filesystem::path(options.output) / "CARD.md", text);
  }
  spdlog::info("wrote {} cases to {}", written, options.output);
  return 0;
}

}  // namespace faceprobe::cli
