#include "eval_results.h"

#include "faceprobe/eval/earlier_rows.h"
#include "faceprobe/io/data_files.h"
#include "paper/headlines.h"
#include "paper/report_notes.h"

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct ResultsOptions {
  std::filesystem::path report;
  std::filesystem::path earlier;
  bool headlines = false;
  bool json = false;
};

int run(const ResultsOptions& options) {
  eval::PaperReport report = read_report(options.report);
  if (!options.earlier.empty()) {
    const eval::PaperReport earlier = read_report(options.earlier);
    eval::add_earlier_rows(report, earlier);
    eval::add_earlier_sections(report, earlier);
    make_readable(report);
  }
  fmt::print("{}", options.headlines ? headlines(report)
                   : options.json    ? eval::report_json(report)
                                     : eval::report_markdown(report));
  return 0;
}

}  // namespace

eval::PaperReport read_report(const std::filesystem::path& json) {
  constexpr std::int64_t kMostBytes = std::int64_t{1} << 28;
  eval::PaperReport report = eval::report_from_json(io::read_text(json, kMostBytes));
  make_readable(report);
  return report;
}

CLI::App* add_eval_results(CLI::App& eval, Action& action) {
  auto options = std::make_shared<ResultsOptions>();
  CLI::App* command = eval.add_subcommand("results", "prints the figures of a report as Markdown");
  command->add_option("REPORT", options->report, "report.json that `faceprobe eval paper` wrote")
      ->type_name("FILE")
      ->required();
  command->add_flag("--headlines", options->headlines, "the few figures that a first page quotes, instead of all");
  command
      ->add_option(
          "--earlier", options->earlier,
          "report.json of an earlier run on the same photos, for rows and parts that are not in REPORT; default: none")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "the report as JSON, what came from the earlier one included");
  command->footer("Example:\n  faceprobe eval results report/report.json > results.md");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
  return command;
}

}  // namespace faceprobe::cli
