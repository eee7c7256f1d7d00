#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/picture_file.h"
#include "json_line.h"
#include "torch_side.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string people;
  std::string start;
  std::string synthetic;
  std::string validation;
  std::string output;
  std::string config_file;
  int most_people = 64;
  bool json = false;
  train::PeopleOptions photos;
  train::FinetuneConfig given;  // what the options say, or its defaults
  // One for each option that sets a field of the config: from `given`, where the option was given.
  std::vector<std::function<void(train::FinetuneConfig&, const train::FinetuneConfig& given)>> overrides;
};

std::atomic<bool> interrupted = false;

// The file's, with what was given beside it in its place.
train::FinetuneConfig config_of(const Options& options) {
  constexpr std::int64_t kMaxBytes = 1 << 20;
  train::FinetuneConfig config;
  if (!options.config_file.empty())
    config = train::finetune_config_from_json(io::read_text(options.config_file, kMaxBytes));
  for (const auto& override_one : options.overrides) override_one(config, options.given);
  if (const std::string fault = config.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  return config;
}

void log_score(const train::FinetuneScore& score) {
  std::string faces;
  if (score.synthetic_rmse > 0) faces = fmt::format(", error on synthetic faces {:.2f}", score.synthetic_rmse);
  spdlog::info("after step {}, people held out: residual {:.5f}, highlight {:.4f}{}", score.step, score.residual,
               score.energy, faces);
}

void print_json(const train::FinetuneReport& report, std::chrono::duration<double> taken) {
  const auto row = [&report](const train::FinetuneScore& score) {
    nlohmann::ordered_json json = {{"beyond_rank_one", score.residual},
                                   {"no_highlights_taken_off", score.untouched},
                                   {"mean_highlight", score.energy}};
    if (report.validated) json["synthetic_rmse"] = score.synthetic_rmse;
    return json;
  };
  print_json_line({{"finished", report.finished},
                   {"steps", report.rows.empty() ? 0 : report.rows.back().step},
                   {"step_kept", report.after.step},
                   {"people_held_out", report.before.people},
                   {"before", row(report.before)},
                   {"after", row(report.after)},
                   {"weights", report.weights.string()},
                   {"seconds", taken.count()}});
}

int run(Options options) {
  const auto start = std::chrono::steady_clock::now();
  train::FinetuneRun run;
  run.config = config_of(options);
  options.photos.least_photos = run.config.photos;
  options.photos.most_photos = std::max(options.photos.most_photos, run.config.photos);
  const auto log = [](const std::string& text) { spdlog::info("{}", text); };
  run.people = std::filesystem::exists(std::filesystem::path(options.people) / "index.json")
                   ? train::load_synthetic_people(options.people, options.most_people, options.photos, log)
                   : train::load_people(options.people, options.photos, log);
  run.start = options.start;
  run.synthetic = options.synthetic;
  run.validation = options.validation;
  run.folder = options.output;
  run.threads = options.photos.threads;
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  train::FinetuneHooks hooks;
  hooks.progress = [](const train::FinetuneRow& row, std::int64_t steps) {
    spdlog::info("step {} of {}: residual {:.5f}, highlight {:.4f}, guards {:.5f}, loss on synthetic faces {:.5f}",
                 row.step, steps, row.residual, row.energy, row.guards, row.synthetic_loss);
  };
  hooks.scored = log_score;
  hooks.stop = [] { return interrupted.load(); };
  hooks.write_picture = [](const std::filesystem::path& path, const ByteImage& picture) {
    io::write_picture(path, picture);
  };
  const train::FinetuneReport report = torch_side().finetune_highlight(run, hooks);
  if (options.json) {
    print_json(report, std::chrono::steady_clock::now() - start);
  } else if (report.finished) {
    fmt::print("{}", train::finetune_table(report));
  }
  if (!report.finished) spdlog::warn("stopped; the same command goes on from here");
  return 0;
}

// An option that has its say over the config's file.
template <class Value>
CLI::Option* add_field(CLI::App& command, Options& options, const std::string& name,
                       Value train::FinetuneConfig::*field, const std::string& help) {
  CLI::Option* option = command.add_option(name, options.given.*field, help)->capture_default_str();
  options.overrides.emplace_back([option, field](train::FinetuneConfig& config, const train::FinetuneConfig& given) {
    if (option->count() > 0) config.*field = given.*field;
  });
  return option;
}

void add_config_fields(CLI::App& command, Options& options) {
  using Config = train::FinetuneConfig;
  add_field(command, options, "--mode", &Config::mode, "the loss; paper: second singular value, nothing blurred")
      ->check(CLI::IsMember({"default", "paper"}));
  add_field(command, options, "--steps", &Config::steps, "steps of training");
  add_field(command, options, "--photos", &Config::photos, "photos of one person in a step");
  add_field(command, options, "--synthetic-batch", &Config::synthetic_batch, "synthetic faces in a step");
  add_field(command, options, "--learning-rate", &Config::learning_rate, "learning rate of AdamW");
  add_field(command, options, "--weight", &Config::weight,
            "weight of the people's loss against that on synthetic faces");
  add_field(command, options, "--energy-weight", &Config::energy_weight,
            "weight, within the people's loss, of the hold on each photo's mean highlight");
  add_field(command, options, "--largest-gradient", &Config::largest_gradient, "norm that a step's gradient is cut to");
  add_field(command, options, "--ema", &Config::ema,
            "decay of the running mean of the weights, which is kept; 0 = the weights themselves");
  add_field(command, options, "--held-out", &Config::held_out_share, "share of the people to measure on");
  add_field(command, options, "--score-every", &Config::score_every, "steps between scores; 0 = at the end alone");
  add_field(command, options, "--validation-samples", &Config::validation_samples,
            "faces of --validation that scores are taken on");
  add_field(command, options, "--max-validation-rise", &Config::max_validation_rise,
            "share by which the error on those may rise in what is kept");
  add_field(command, options, "--save-every", &Config::save_every, "steps between checkpoints");
  add_field(command, options, "--seed", &Config::seed, "the same seed gives the same run");
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
  command
      ->add_option("--validation", options->validation,
                   "such a folder of other people, to measure on and to choose by; default: neither")
      ->type_name("DIR");
  command->add_option("-o,--output", options->output, "folder for checkpoint, log, pictures and weights")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--config", options->config_file,
                   "finetuning config, JSON, over which the options below go; default: theirs")
      ->check(CLI::ExistingFile);
  add_config_fields(*command, *options);
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
  command->add_option("--most-people", options->most_people, "synthetic people at all")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--threads", options->photos.threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end, in place of the table");
  command->footer(
      "Prints a table of people it was not trained on. Kept are the weights of the last step that was scored and whose "
      "error on the faces of --validation has not risen too much. An interrupted run goes on bit for bit when the same "
      "command is given again. Weights inherit the terms of the photos.\n\n"
      "Example:\n"
      "  faceprobe finetune --config models/finetune.json --people people --start models/face.safetensors "
      "--data faces/train --validation faces/dev -o finetuned");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
