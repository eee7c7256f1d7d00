#include "commands.h"
#include "faceprobe/train/finetune.h"
#include "json_line.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string people;
  std::string start;
  std::string synthetic;
  std::string output;
  int most_people = 64;
  bool json = false;
  train::PeopleOptions photos;
  train::FinetuneConfig config;
};

std::atomic<bool> interrupted = false;

void print_table(const train::FinetuneReport& report) {
  fmt::print(
      "{} people held out\n\n| | beyond rank one | no highlights taken off | mean highlight |\n| --- | ---: | ---: | "
      "---: |\n",
      report.before.people);
  const auto row = [](const char* name, const train::PeopleScore& score) {
    fmt::print("| {} | {:.5f} | {:.5f} | {:.4f} |\n", name, score.residual, score.untouched, score.energy);
  };
  row("before", report.before);
  row("after", report.after);
}

void print_json(const train::FinetuneReport& report, std::chrono::duration<double> taken) {
  const auto row = [](const train::PeopleScore& score) {
    return nlohmann::ordered_json{{"beyond_rank_one", score.residual},
                                  {"no_highlights_taken_off", score.untouched},
                                  {"mean_highlight", score.energy}};
  };
  print_json_line({{"finished", report.finished},
                   {"steps", report.rows.empty() ? 0 : report.rows.back().step},
                   {"people_held_out", report.before.people},
                   {"before", row(report.before)},
                   {"after", row(report.after)},
                   {"weights", report.weights.string()},
                   {"seconds", taken.count()}});
}

int run(Options options) {
  const auto start = std::chrono::steady_clock::now();
  train::FinetuneRun run;
  options.photos.least_photos = options.config.photos;
  options.photos.most_photos = std::max(options.photos.most_photos, options.config.photos);
  const auto log = [](const std::string& text) { spdlog::info("{}", text); };
  run.people = std::filesystem::exists(std::filesystem::path(options.people) / "index.json")
                   ? train::load_synthetic_people(options.people, options.most_people, options.photos, log)
                   : train::load_people(options.people, options.photos, log);
  run.config = options.config;
  run.start = options.start;
  run.synthetic = options.synthetic;
  run.folder = options.output;
  run.threads = options.photos.threads;
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  train::FinetuneHooks hooks;
  hooks.progress = [](const train::FinetuneRow& row, std::int64_t steps) {
    spdlog::info("step {} of {}: residual {:.5f}, highlight {:.4f}, guards {:.5f}, loss on synthetic faces {:.5f}",
                 row.step, steps, row.residual, row.energy, row.guards, row.synthetic_loss);
  };
  hooks.stop = [] { return interrupted.load(); };
  const train::FinetuneReport report = train::finetune_highlight(run, hooks);
  if (options.json) {
    print_json(report, std::chrono::steady_clock::now() - start);
  } else {
    print_table(report);
  }
  return 0;
}

}  // namespace

void add_finetune(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("finetune", "improves the network's highlights on photos of people, several of each");
  command
      ->add_option("--people", options->people,
                   "folder with one folder of photos a person, at any depth, or one that `faceprobe synth` wrote")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--start", options->start, "weights to begin with")->type_name("FILE")->required();
  command
      ->add_option("--data", options->synthetic, "folder that `faceprobe synth` wrote, for every step's synthetic faces")
      ->type_name("DIR")
      ->required();
  command->add_option("-o,--output", options->output, "folder for weights and log")->type_name("DIR")->required();
  command->add_option("--mode", options->config.mode, "the loss; paper: second singular value, nothing blurred")
      ->capture_default_str()
      ->check(CLI::IsMember({"default", "paper"}));
  command->add_option("--steps", options->config.steps, "steps of training")->capture_default_str();
  command->add_option("--photos", options->config.photos, "photos of one person in a step")->capture_default_str();
  command->add_option("--most-photos", options->photos.most_photos, "photos of one person at all")->capture_default_str();
  command
      ->add_option("--max-expression", options->photos.max_expression,
                   "error of the rigid mean face per width of the face, above which a photo is left out")
      ->capture_default_str();
  command
      ->add_option("--max-light-colours", options->photos.max_light_colours,
                   "spread of chromaticity of the light on the skin, above which a photo is left out")
      ->capture_default_str();
  command->add_flag("--calibrate", options->photos.calibrate,
                    "decode each photo by the response curve that its skin tells of, not as sRGB");
  command->add_option("--synthetic-batch", options->config.synthetic_batch, "synthetic faces in a step")
      ->capture_default_str();
  command->add_option("--learning-rate", options->config.learning_rate, "learning rate of AdamW")->capture_default_str();
  command->add_option("--weight", options->config.weight, "weight of the people's loss against that on synthetic faces")
      ->capture_default_str();
  command
      ->add_option("--energy-weight", options->config.energy_weight,
                   "weight, within the people's loss, of the hold on each photo's mean highlight")
      ->capture_default_str();
  command->add_option("--most-people", options->most_people, "synthetic people at all")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--held-out", options->config.held_out_share, "share of the people to measure on")
      ->capture_default_str();
  command->add_option("--seed", options->config.seed, "the same seed gives the same run")->capture_default_str();
  command->add_option("--threads", options->photos.threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end, in place of the table");
  command->footer(
      "Prints a table of people it was not trained on. Weights inherit the terms of the photos.\n\nExample:\n"
      "  faceprobe finetune --people people --start models/face.safetensors --data faces/train -o finetuned");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
