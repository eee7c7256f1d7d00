#include "faceprobe/eval/case_benchmark.h"

#include "eval/case_cache.h"
#include "eval/map_metrics.h"
#include "eval/markdown.h"
#include "eval/nan.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/image_metrics.h"
#include "faceprobe/eval/light_metrics.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;

constexpr int kCaseNside = 16;

// One method on one case.
struct CaseRun {
  std::string failure;  // empty: there is a result
  CaseResult result;
  double seconds = kNaN;
};

CaseRun run_or_recall(const CaseMethod& method, const Case& one, const fs::path& folder, const CaseEntry& entry) {
  CaseRun run;
  const auto read = [&] { run.result = read_case_result(entry.out(), one.photo.width(), one.photo.height()); };
  if (const std::optional<double> seconds = entry.finished_seconds()) {
    try {
      read();
      run.seconds = *seconds;
      return run;
    } catch (const Error&) {
      // What was kept is damaged: it is made again.
    }
  }
  entry.begin();
  const auto start = std::chrono::steady_clock::now();
  run.failure = method.run({fs::absolute(folder).lexically_normal(), entry.out(), entry.log()});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!run.failure.empty()) return run;
  try {
    read();
  } catch (const Error& error) {
    run.failure = error.what();
    return run;
  }
  run.seconds = seconds;
  entry.finish(method.name, one.name, seconds);
  return run;
}

std::map<std::string, double> highlight_metrics(const Case& one, const Image& found) {
  if (found.empty()) return {{"rmse", kNaN}, {"ssim", kNaN}};
  return {{"rmse", rmse(found, one.highlight, one.mask)}, {"ssim", ssim(found, one.highlight, one.mask)}};
}

// Names that our own columns have.
constexpr std::array<std::string_view, 19> kTakenNames = {
    "diffuse",      "glossy",        "si_diffuse",  "si_matte",     "si_mirror", "angle_diffuse",   "angle_matte",
    "angle_mirror", "nrmse_diffuse", "nrmse_matte", "nrmse_mirror", "nrmse_map", "nrmse_map_truth", "colour",
    "main_light",   "rmse",          "ssim",        "light",        "failure"};

std::vector<fs::path> chosen_cases(const std::vector<fs::path>& folders, int samples) {
  const std::size_t taken = std::min(folders.size(), static_cast<std::size_t>(samples));
  std::vector<fs::path> chosen;
  chosen.reserve(taken);
  for (std::size_t i = 0; i < taken; ++i) chosen.push_back(folders[i * folders.size() / taken]);
  return chosen;
}

// Whether a method ever wrote such a thing; one that never wrote anything is held to all.
struct Says {
  bool light = false;
  bool highlight = false;
  bool about_light() const { return light || !highlight; }
  bool about_highlight() const { return highlight || !light; }
};

// Rows wait until it is known which tables their methods belong to.
struct WaitingRow {
  std::size_t method;
  bool of_light;
  ScoreRow row;
};

class CaseMeasurement {
 public:
  CaseMeasurement(const std::vector<CaseMethod>& methods, const CaseBenchmark& options)
      : methods_(methods), options_(options), says_(methods.size()) {
    scores_.light.order_labels("tone", tone_names());
    scores_.highlight.order_labels("tone", tone_names());
  }

  void measure(const fs::path& folder) {
    const Case one = read_case(folder);
    const std::string hash = case_hash(folder);
    std::map<std::string, std::string> groups = one.groups;
    const auto person = groups.extract("person");
    const std::string shown = person ? person.mapped() : std::string();
    Eigen::MatrixX3f truth;
    if (one.light) {
      truth = grid_from_env_map(*one.light, grid_);
      groups["light"] = has_dominant_light(truth, grid_) ? "one lamp" : "several or soft";
    }
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const CaseEntry entry(options_.work, hash, methods_[m].identity);
      if (const std::optional<CaseFigures> known = entry.figures(options_.scoring)) {
        note(m, one.name, entry, "", *known, *entry.finished_seconds(), groups, shown);
        continue;
      }
      const CaseRun run = run_or_recall(methods_[m], one, folder, entry);
      const CaseFigures figures = figures_of(one, truth, run.result);
      if (run.failure.empty()) entry.keep(figures, options_.scoring);
      note(m, one.name, entry, run.failure, figures, run.seconds, groups, shown);
    }
    ++scores_.cases;
  }

  CaseScores scores() && {
    for (WaitingRow& waiting : waiting_) {
      const Says& says = says_[waiting.method];
      if (waiting.of_light && says.about_light()) scores_.light.add(std::move(waiting.row));
      if (!waiting.of_light && says.about_highlight()) scores_.highlight.add(std::move(waiting.row));
    }
    return std::move(scores_);
  }

 private:
  CaseFigures figures_of(const Case& one, const Eigen::MatrixX3f& truth, const CaseResult& result) {
    CaseFigures figures{result.light.has_value(), !result.highlight.empty(), {}, {}};
    if (one.light) {
      if (!object_) object_ = options_.object();
      const Eigen::MatrixX3f found = result.light ? grid_from_env_map(*result.light, grid_) : Eigen::MatrixX3f();
      figures.light = map_metrics(truth, found, *object_, grid_, has_dominant_light(truth, grid_));
    }
    if (!one.highlight.empty()) figures.highlight = highlight_metrics(one, result.highlight);
    return figures;
  }

  void note(std::size_t m, const std::string& name, const CaseEntry& entry, const std::string& failure,
            const CaseFigures& figures, double seconds, std::map<std::string, std::string> groups,
            const std::string& person) {
    const std::string& method = methods_[m].name;
    std::map<std::string, std::string> about = {{"folder", entry.folder().filename().string()}};
    if (!failure.empty()) {
      about["failure"] = groups["failure"] = failure;
      scores_.failures.push_back({method, name, failure, entry.folder()});
    }
    scores_.runs.add({method, name, about, {{"seconds", seconds}}});
    says_[m].light = says_[m].light || figures.has_light;
    says_[m].highlight = says_[m].highlight || figures.has_highlight;
    if (!figures.light.empty()) waiting_.push_back({m, true, {method, name, groups, figures.light, person}});
    if (!figures.highlight.empty()) waiting_.push_back({m, false, {method, name, groups, figures.highlight, person}});
  }

  const std::vector<CaseMethod>& methods_;
  const CaseBenchmark& options_;
  const SphereGrid grid_{kCaseNside};
  std::optional<LitObject> object_;
  std::vector<Says> says_;
  std::vector<WaitingRow> waiting_;
  CaseScores scores_;
};

}  // namespace

CaseMethod ambient_case_method() {
  return {"ambient", "ambient", [](const CaseRunPaths& paths) {
            EnvMap even(8, 4);
            for (float& value : even.radiance().values()) value = 1;
            io::write_env_map(paths.out / "map.hdr", even);
            return std::string();
          }};
}

std::string CaseBenchmark::validate() const {
  if (work.empty()) return "No folder is named for what the methods write.";
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

std::string CaseScores::missing_markdown() const {
  if (failures.empty()) return {};
  std::string text = "| method | case | reason | folder |\n|---|---|---|---|\n";
  for (const CaseFailure& failure : failures) {
    text += "| " + markdown_cell(failure.method) + " | " + markdown_cell(failure.sample) + " | " +
            markdown_cell(failure.reason) + " | " + markdown_cell(failure.folder.string()) + " |\n";
  }
  return text;
}

CaseScores measure_cases(const fs::path& data, const std::vector<CaseMethod>& methods, const CaseBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const std::vector<fs::path> known = case_folders(data);
  const std::vector<fs::path> chosen = chosen_cases(known, options.samples);
  // A fault in the last case must not show after hours of work on the others.
  for (const fs::path& folder : chosen) {
    for (const auto& group : read_case(folder).groups) {
      if (std::ranges::find(kTakenNames, group.first) != kTakenNames.end()) {
        throw Error(ExitCode::kInput, (folder / "case.json").string() + " has a group named '" + group.first +
                                          "', which is a column of the results; give it another name.");
      }
    }
  }
  CaseMeasurement measurement(methods, options);
  int done = 0;
  for (const fs::path& folder : chosen) {
    measurement.measure(folder);
    if (options.progress) options.progress(++done, static_cast<int>(chosen.size()));
  }
  CaseScores scores = std::move(measurement).scores();
  scores.known = static_cast<int>(known.size());
  return scores;
}

}  // namespace faceprobe::eval
