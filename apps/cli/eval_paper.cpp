#include "eval_paper.h"

#include "eval_results.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"
#include "faceprobe/eval/earlier_rows.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/synth/shard.h"
#include "paper/plan.h"
#include "paper/print_pdf.h"
#include "paper/report_notes.h"
#include "paper/section_cache.h"
#include "program_light_methods.h"
#include "progress.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::cli {

namespace {

constexpr const char* kHighlightRivals[] = {"mscr.safetensors", "finetuned.safetensors", "shi.safetensors"};
constexpr const char* kLightRivals[] = {"gardner.safetensors", "legendre.safetensors", "sky.safetensors"};
constexpr const char* kFaceRivals[] = {"legendre.safetensors"};

struct Part {
  const char* name;
  Sections (*measure)(const PaperPlan&);
  std::span<const char* const> rivals = {};  // files of weights that it asks for
  bool has_programs = false;                 // whether the plan's methods have rows in it
};
constexpr std::array kParts = {Part{"highlights", highlight_sections, kHighlightRivals},
                               Part{"objects", object_sections},
                               Part{"relighting", relight_sections, kLightRivals, true},
                               Part{"directions", direction_sections, kFaceRivals},
                               Part{"triangulation", room_sections},
                               Part{"ablations", ablation_sections}};

std::function<void(int, int)> part_progress(const std::string& part) {
  return [part, progress = std::make_shared<Progress>()](int done, int total) {
    progress->show(done, total, fmt::format("{}: {} of {}", part, done, total));
  };
}

// What synthetic faces are made of; nothing where they are all there.
void require_data(const PaperPlan& plan) {
  const bool all_there = (!plan.faces.empty() || !plan.measures("highlights")) &&
                         (!plan.light.empty() || !(plan.measures("relighting") || plan.measures("ablations"))) &&
                         (!plan.groups.empty() || !plan.measures("triangulation"));
  if (all_there) return;
  for (const char* needed : {"faces/ict_facekit", "hdri/dev"}) {
    if (!std::filesystem::is_directory(plan.data / needed)) {
      throw Error(ExitCode::kInput, "There is no " + (plan.data / needed).string() +
                                        ". --data names the folder that docs/data.md lays out.");
    }
  }
}

// What was measured, without anybody's folders.
std::string made_with(const PaperPlan& plan) {
  if (!plan.parts.empty())
    return fmt::format("Faceprobe {}; parts measured: {}.", kVersion, fmt::join(plan.parts, ", "));
  const auto of = [](const std::filesystem::path& faces, int wanted) {
    return std::min(wanted, synth::ShardReader(faces).sample_count());
  };
  return fmt::format(
      "Faceprobe {}. {} photos for highlights, {} for light, {} groups{}; synthetic faces of people, skins and lights "
      "that no network was "
      "trained on, photos and HDR maps as docs/data.md names them.{}",
      kVersion, of(plan.faces, plan.highlight_photos()), of(plan.light, plan.light_photos()),
      of(plan.groups, plan.group_photos()),
      plan.distant.empty() ? ""
                           : fmt::format(" and {} under distant light alone", of(plan.distant, plan.distant_photos())),
      plan.quick ? " A quick run: too few photos to compare methods by." : "");
}

int run(PaperPlan plan) {
  require_data(plan);
  const std::string programs = identity_of_programs(plan.methods, plan.seconds);
  const eval::PaperReport earlier = plan.earlier.empty() ? eval::PaperReport() : read_report(plan.earlier);
  io::create_folder(plan.output);
  plan.progress = part_progress("synthetic faces");
  make_paper_faces(plan);
  const std::string data = identity_of_data(plan);
  eval::PaperReport report{.title = "Light from faces: the evaluation", .made_with = made_with(plan)};
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    if (!plan.measures(kParts[i].name)) continue;
    plan.progress = part_progress(fmt::format("{}, part {} of {}", kParts[i].name, i + 1, kParts.size()));
    const std::string key = key_of(plan, data, kParts[i].rivals, kParts[i].has_programs ? programs : "");
    Sections sections = cached_part(plan, key, kParts[i].name, kParts[i].measure);
    std::move(sections.begin(), sections.end(), std::back_inserter(report.sections));
    spdlog::info("part {} of {}, {}: done", i + 1, kParts.size(), kParts[i].name);
  }
  make_readable(report);  // its rows are named as those of the earlier report are, once that is read
  if (!plan.earlier.empty()) {
    if (!plan.parts.empty()) report.made_with += "\n\nThe other parts are from an earlier report: " + earlier.made_with;
    const std::set<std::string> taken = eval::add_earlier_rows(report, earlier);
    for (const std::string& title : eval::add_earlier_sections(report, earlier))
      spdlog::info("'{}' is from {}", title, plan.earlier.string());
    if (taken.empty()) {
      spdlog::warn("no row could be taken from {}: it has none that is missing here, or is of other photos",
                   plan.earlier.string());
    } else {
      spdlog::info("rows of {} methods are from {}", taken.size(), plan.earlier.string());
    }
    make_readable(report);
  }
  const std::filesystem::path html = plan.output / "report.html";
  io::write_file_atomically(html, eval::report_html(report));
  io::write_file_atomically(plan.output / "report.json", eval::report_json(report));
  io::write_file_atomically(plan.output / "report.csv", eval::report_csv(report));
  io::write_file_atomically(plan.output / "report.md", eval::report_markdown(report));
  if (const std::string problem = print_pdf(html, plan.output / "report.pdf"); !problem.empty()) spdlog::warn(problem);
  spdlog::info("wrote {}", html.string());
  return 0;
}

}  // namespace

CLI::App* add_eval_paper(CLI::App& eval, Action& action) {
  auto plan = std::make_shared<PaperPlan>();
  CLI::App* command = eval.add_subcommand("paper", "the paper's whole evaluation and its rivals as one report");
  command->add_option("--data", plan->data, "the folder that docs/data.md lays out")->type_name("DIR")->required();
  command->add_option("-o,--output", plan->output, "folder for the report, its cache and the synthetic faces")
      ->type_name("DIR")
      ->required();
  command->add_flag("--quick", plan->quick, "few photos of each kind: a look in minutes, no figures to quote");
  command
      ->add_option("--faces", plan->faces, "synthetic faces of 128 px to measure on; default: made in the output folder")
      ->type_name("DIR");
  command->add_option("--light", plan->light, "synthetic faces of 256 px; default: made likewise")->type_name("DIR");
  command->add_option("--groups", plan->groups, "synthetic groups; default: made likewise")->type_name("DIR");
  command
      ->add_option("--distant", plan->distant,
                   "synthetic groups under distant light alone (synth --lamps 0); default: made likewise, but not "
                   "measured where --groups names some")
      ->type_name("DIR");
  command
      ->add_option("--training", plan->training,
                   "traced training faces, for the rows that learn from them; default: no such rows")
      ->type_name("DIR");
  command
      ->add_option("--rivals", plan->rivals,
                   "folder of weights of rival networks, such as mscr.safetensors; default: no such rows")
      ->type_name("DIR");
  command
      ->add_option("--method", plan->methods,
                   "again and again: a program with a row in relighting, which reads case folders and writes maps as "
                   "for `eval cases`; default: none")
      ->type_name("NAME=COMMAND")
      ->allow_extra_args(false);
  command->add_option("--seconds", plan->seconds, "time that such a program has for one photo")
      ->capture_default_str()
      ->check(CLI::Range(1, 86400));
  std::vector<std::string> parts;
  for (const Part& part : kParts) parts.emplace_back(part.name);
  command->add_option("--parts", plan->parts, "measure these parts alone, separated by commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(parts))
      ->type_name("PART,...");
  command
      ->add_option(
          "--earlier", plan->earlier,
          "report.json of an earlier run on the same photos, such as docs/results.json, for rows and parts that "
          "this run lacks; default: none")
      ->type_name("FILE");
  command->add_option("--threads", plan->threads, "threads; 0 = all processors")->capture_default_str();
  command->footer(
      "Writes report.html, .pdf, .json, .csv and .md. A run that was cut off goes on where it was; what was measured "
      "with the same "
      "program, weights and data is not measured again.\n\nExample:\n  faceprobe eval paper --data data --quick -o "
      "report");
  command->callback([plan, &action] { action = [plan] { return run(*plan); }; });
  return command;
}

}  // namespace faceprobe::cli
