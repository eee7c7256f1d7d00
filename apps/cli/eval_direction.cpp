#include "eval_stages.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "one_head.h"
#include "paper/direction_setting.h"
#include "paper/directions.h"
#include "paper/report_notes.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>

namespace faceprobe::cli {

namespace {

using pipeline::NormalSource;

NormalSource normals_named(const std::string& name) {
  for (const NormalSource normals : {NormalSource::kMesh, NormalSource::kNet, NormalSource::kFit}) {
    if (name == normals_option(normals)) return normals;
  }
  throw Error(ExitCode::kUsage, "--normals takes mesh, net and 3dmm, found '" + name + "'.");
}

void choose_normals(const EvalOptions& options, DirectionRows& rows) {
  for (const std::string& name : options.normals) {
    const NormalSource normals = normals_named(name);
    if (std::ranges::count(rows.normals, normals) == 0) rows.normals.push_back(normals);
  }
  const bool fitted = std::ranges::count(rows.normals, NormalSource::kFit) > 0;
  if (fitted == options.head.empty()) {
    throw Error(ExitCode::kUsage, fitted ? "--normals 3dmm fits a head model; name it with --head PATH."
                                         : "--head is the model that --normals 3dmm fits; give that too.");
  }
  if (fitted) rows.base.surface_fit = surface_of_head(options.head, options.threads);
}

}  // namespace

int eval_direction(const EvalOptions& options) {
  DirectionRows rows{.data = options.data,
                     .every = options.every,
                     .yale = options.set != "london",
                     .london = options.set != "yale",
                     .changed = true,
                     .progress = eval_progress()};
  if (!has_directions(rows.data)) {
    throw Error(ExitCode::kInput, options.data +
                                      " has neither real/yaleB nor real/portraits/london. --data names the folder that "
                                      "docs/data.md lays out.");
  }
  if (!options.weights.empty()) rows.base.weights = name_and_file(options.weights[0]).second;
  rows.base.prior_weights = options.prior;
  rows.base.threads = options.threads;
  choose_normals(options, rows);
  if (rows.normals.empty())
    rows.rivals =
        direction_rivals({.training = options.training, .weights = options.rivals, .threads = options.threads});
  eval::PaperReport report{.title = "", .sections = measure_directions(rows)};
  make_readable(report);
  report.terms.clear();  // of the whole report
  fmt::print("{}", eval::report_markdown(report));
  if (options.output.empty()) return 0;
  report.title = "Directions of light";
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "direction.html", eval::report_html(report));
  io::write_file_atomically(folder / "direction.csv", eval::report_csv(report));
  io::write_file_atomically(folder / "direction.json", eval::report_json(report));
  return 0;
}

}  // namespace faceprobe::cli
