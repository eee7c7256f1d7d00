#pragma once
// Methods against the cases of a folder (eval/case_folder.h), whatever the methods are: each reads a case folder and writes files.
//
//   const std::vector<eval::CaseMethod> methods = {eval::ambient_case_method(), ...};
//   const eval::CaseScores scores = eval::measure_cases("cases", methods, {.work = "out/cache"});
//   std::cout << scores.light.markdown("diffuse", 1) << scores.missing_markdown();
//
// What a method wrote is kept in `work` under the contents of the case and the method's identity, and taken from there the next time, its
// figures too; what failed is tried again. One run at a time in one such folder.

#include "faceprobe/eval/case_folder.h"
#include "faceprobe/eval/lit_object.h"
#include "faceprobe/eval/score_table.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::eval {

// Absolute paths.
struct CaseRunPaths {
  std::filesystem::path data;  // the case folder
  std::filesystem::path out;   // an empty folder, for what read_case_result() reads
  std::filesystem::path log;   // a file that may be written
};

struct CaseMethod {
  std::string name;
  std::string identity;  // all that the result hangs on beside the case, such as a command and a version
  // Returns why there is no result, in a few words ("exit code 3"), or nothing. What it throws ends the benchmark.
  std::function<std::string(const CaseRunPaths&)> run;
};
// The same light from everywhere: what everything has to be better than.
CaseMethod ambient_case_method();

struct CaseBenchmark {
  std::filesystem::path work;  // folder for what the methods write
  // What stands in the light, on a grid of 3072 cells. Made when it is needed: that takes seconds.
  std::function<LitObject()> object = [] { return LitObject(sphere_mesh()); };
  // All that figures hang on beside a result, such as the object's file and the program; empty = figures are not kept.
  std::string scoring = {};
  int samples = 100;                                       // cases, spread evenly over their names
  std::function<void(int done, int total)> progress = {};  // of cases

  std::string validate() const;
};

struct CaseFailure {
  std::string method;
  std::string sample;            // the case's name
  std::string reason;            // one sentence or a few words
  std::filesystem::path folder;  // of the run; log.txt in it has what the method said
};

// A row is missing where a method failed; it is left out where the truth is not known. A method that never writes a map, or a highlight layer, is
// in the other table alone.
struct CaseScores {
  int cases = 0;  // measured
  int known = 0;  // in the data
  // Metrics of relight_benchmark.h but the sun's: diffuse, glossy, si_*, angle_*, nrmse_*, colour, and main_light where one lamp dominates.
  ScoreTable light;
  // "rmse" (0-255) and "ssim" (image_metrics.h) where the mask is 255.
  ScoreTable highlight;
  // Metric: "seconds", NaN where it failed. Groups: "folder", under the benchmark's `work`, and "failure".
  ScoreTable runs;
  std::vector<CaseFailure> failures;

  // Method, case, reason, folder; empty when nothing failed.
  std::string missing_markdown() const;
};
// Groups of the first two tables are the cases' own but for "person", which says whom a row shows, "light" ("one lamp", "several or soft") and "failure" (the reason). All cases are read before a
// method runs. Throws Error(kUsage) for options that do not validate, Error(kInput) for a case that is not in order or
// has a group of a metric's name, Error(kOutput).
CaseScores measure_cases(const std::filesystem::path& data, const std::vector<CaseMethod>& methods,
                         const CaseBenchmark& options);

}  // namespace faceprobe::eval
