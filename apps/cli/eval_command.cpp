#include "commands.h"
#include "eval_paper.h"
#include "eval_results.h"
#include "eval_stages.h"
#include "faceprobe/core/error.h"
#include "progress.h"
#include "torch_side.h"

#include <spdlog/fmt/fmt.h>

#include <filesystem>
#include <memory>

namespace faceprobe::cli {

std::pair<std::string, std::string> name_and_file(const std::string& named) {
  const std::size_t equals = named.find('=');
  if (equals == std::string::npos) return {std::filesystem::path(named).stem().string(), named};
  return {named.substr(0, equals), named.substr(equals + 1)};
}

void refuse_missing_device(const std::string& device) {
  if (device != "auto" && device != "cpu") torch_side().device_from_name(device);
}

std::function<void(int, int)> eval_progress() {
  return [progress = std::make_shared<Progress>()](int done, int total) {
    progress->show(done, total, fmt::format("{} of {} photos", done, total));
  };
}

namespace {

int run(const EvalOptions& options) {
  if (options.stage.empty() || options.data.empty()) {
    throw Error(ExitCode::kUsage, options.stage.empty() ? "What is to be measured? A stage is wanted, see --help."
                                                        : "--data is missing: the folder to measure on.");
  }
  if (options.stage == "geometry") return eval_geometry(options);
  if (options.stage == "shading") return eval_shading(options);
  if (options.stage == "relight") return eval_relight(options);
  if (options.stage == "direction") return eval_direction(options);
  if (options.stage == "insert") return eval_insert(options);
  if (options.stage == "triangulate") return eval_triangulate(options);
  if (options.stage == "cases") return eval_cases(options);
  if (options.stage == "export-cases") return eval_export_cases(options);
  return eval_highlight(options);
}

}  // namespace

void add_eval(CLI::App& program, Action& action) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command = program.add_subcommand("eval", "measures a stage on data whose answer is known");
  command->add_option("STAGE", options->stage, "what to measure")
      ->check(CLI::IsMember({"highlight", "geometry", "shading", "relight", "direction", "insert", "triangulate",
                             "cases", "export-cases"}));
  command
      ->add_option("--data", options->data,
                   "folder that `faceprobe synth` wrote; for direction: the one that docs/data.md lays out; for cases: "
                   "with one folder a case, see docs/cases.md; "
                   "default: none, it has to be named")
      ->type_name("DIR");
  command
      ->add_option(
          "--weights", options->weights,
          "networks to measure beside what needs none; default: none, or where a stage needs one, the program's")
      ->type_name("[NAME=]FILE");
  command->add_option("--samples", options->samples, "photos or cases to measure")->capture_default_str();
  command
      ->add_option(
          "-o,--output", options->output,
          "folder for STAGE.csv, STAGE.json and a picture, for cases as a page; default: nothing is written, but for "
          "cases and export-cases, which need one")
      ->type_name("DIR");
  command->add_option("--rows", options->rows, "photos in that picture")->capture_default_str()->check(CLI::Range(1, 200));
  command
      ->add_option("--head", options->head,
                   "for geometry and for --normals 3dmm: head model whose fit to the landmarks is a row, as --geometry "
                   "3dmm of estimate; default: no such row")
      ->type_name("PATH");
  command
      ->add_option("--object", options->object,
                   "for relight and cases, an OBJ file to put in the light, default: a sphere; for insert, a shape or "
                   "a model file, default: spheres")
      ->type_name("FILE");
  command
      ->add_option(
          "--scenes", options->scenes,
          "for relight and export-cases: CSV that names the maps indoor or outdoor; default: they are not told "
          "apart")
      ->type_name("FILE");
  command
      ->add_option(
          "--training", options->training,
          "for relight and direction: data whose mean light is a row, and which Knorr and Kurz learn from where it is "
          "traced; default: no such rows")
      ->type_name("DIR");
  command
      ->add_option("--prior-weights", options->prior,
                   "for relight, direction, insert, triangulate, cases: weights of the light prior; default: those "
                   "that come with "
                   "the program")
      ->type_name("FILE");
  command->add_option("--set", options->set, "for direction: the photos to measure on")
      ->check(CLI::IsMember({"yale", "london", "all"}))
      ->capture_default_str();
  command->add_option("--every", options->every, "for direction: every n-th photo of Yale B and person of London alone")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command
      ->add_option("--normals", options->normals,
                   "for direction: our rows with normals from these, in the place of all others, separated by commas: "
                   "mesh, net, or 3dmm (the head model of --head, fitted); default: the usual rows")
      ->type_name("NORMALS,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--rivals", options->rivals,
                   "for direction: folder of weights of rival networks, such as legendre.safetensors; default: no such "
                   "rows")
      ->type_name("DIR");
  command->add_flag("--ablation", options->ablation, "for relight: rows with normals or layers known");
  command
      ->add_option(
          "--method", options->methods,
          "for cases, again and again: a program to measure, run once a case without a shell, with the paths of "
          "the case and of a folder for its files in the place of {case} and {out}; default: ours and ambient "
          "light alone")
      ->type_name("NAME=COMMAND")
      ->allow_extra_args(false);
  command->add_option("--seconds", options->seconds, "for cases: time that such a program has for one")
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
  command
      ->add_option("--device", options->device,
                   "for highlight and shading: what computes; cuda:N is one of several cards")
      ->type_name("{auto,cpu,cuda}")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "threads; 0 = all processors")->capture_default_str();
  command->footer(
      "Prints Markdown.\n\nExamples:\n  faceprobe eval highlight --data faces/dev --weights run/weights.safetensors -o "
      "out\n"
      "  faceprobe eval relight --data faces/dev --scenes scenes.csv\n"
      "  faceprobe eval direction --data data --every 12 --normals mesh,net\n"
      "  faceprobe eval export-cases --data faces/dev --samples 20 -o cases\n"
      "  faceprobe eval cases --data cases --method \"mine=python3 mine.py {case} {out}\" -o out");
  const CLI::App* paper = add_eval_paper(*command, action);
  const CLI::App* results = add_eval_results(*command, action);
  command->callback([options, paper, results, &action] {
    if (!paper->parsed() && !results->parsed()) action = [options] { return run(*options); };
  });
}

}  // namespace faceprobe::cli
