#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/picture_file.h"
#include "json_line.h"
#include "torch_side.h"
#include "train_light_command.h"
#ifndef FACEPROBE_LEAN
#include "train_regressor_command.h"
#include "train_sky_command.h"
#endif

#include <spdlog/spdlog.h>

#include <atomic>
#include <csignal>
#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string net = "highlight";
  std::string config;
  std::string device = "auto";
  std::vector<std::string> scenes;
  bool json = false;
  train::TrainRun run;
};

#ifdef FACEPROBE_LEAN  // which reads no maps
const std::vector<std::string> kNets = {"highlight", "face", "light"};
#else
const std::vector<std::string> kNets = {"highlight", "face", "light", "gardner", "legendre", "sky"};
#endif

// Set by an interrupt: the run ends after the step at hand.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

std::string config_text(const std::string& path) {
  constexpr std::int64_t kMaxBytes = 1 << 20;
  return path.empty() ? std::string() : io::read_text(path, kMaxBytes);
}

// What the trainers of light do not know would be passed over in silence.
void refuse_options_of_highlight(const Options& options) {
  const std::pair<bool, const char*> given[] = {{options.device != "auto", "--device"},
                                                {options.json, "--json"},
                                                {options.run.stop_after != 0, "--stop-after"},
                                                {options.run.workers != 0, "--workers"}};
  for (const auto& [is_given, name] : given) {
    if (is_given)
      throw Error(ExitCode::kUsage, "train " + options.net + " takes no " + name + "; highlight and face do.");
  }
}

void log_row(const train::TrainProgress& progress) {
  const train::TrainRow& row = progress.row;
  std::string errors;
  if (row.validated && row.validation.black_whole > 0) {
    errors =
        fmt::format(", error {:.2f} on skin (black {:.2f}), {:.2f} on the whole (black {:.2f})", row.validation.skin,
                    row.validation.black_skin, row.validation.whole, row.validation.black_whole);
  } else if (row.validated) {  // of shading alone
    errors = fmt::format(", shading off by {:.3f} in its logarithm, its colour by {:.2f} degrees",
                         row.validation.shading, row.validation.colour_deg);
  }
  spdlog::info("step {} of {}: loss {:.5f}, {:.1f} samples a second, {:.0f} min left{}", row.step, progress.steps,
               row.loss, row.samples_per_second, progress.seconds_left / 60, errors);
}

int run(Options options) {
  const std::string config_json = config_text(options.config);
  if (options.net != "sky" && options.net != "gardner" && !options.scenes.empty())
    throw Error(ExitCode::kUsage, "train " + options.net + " takes no --scenes; gardner and sky do.");
  const bool reads_layers = options.net == "highlight" || options.net == "face";
  if (!reads_layers && options.net != "light" && !options.run.more_data.empty())
    throw Error(ExitCode::kUsage, "train " + options.net + " takes no --more; highlight, face and light do.");
  if (!reads_layers) refuse_options_of_highlight(options);
  if (options.net == "light") return train_light(options.run, config_json);
#ifndef FACEPROBE_LEAN
  if (options.net == "gardner") return train_gardner(options.run, config_json, options.scenes);
  if (options.net == "legendre") return train_legendre(options.run, config_json);
  if (options.net == "sky") return train_sky(options.run, config_json, options.scenes);
#endif
  if (!config_json.empty()) options.run.config = train::train_config_from_json(config_json);
  train::TrainConfig& config = options.run.config;
  if (options.config.empty() && options.net == "face") config.architecture = "face";
  if ((config.architecture == "face") != (options.net == "face")) {
    throw Error(ExitCode::kUsage, "The training config's architecture is \"" + config.architecture +
                                      "\", which is not of the network to train, " + options.net +
                                      ". Name face for \"face\", highlight for the others.");
  }
  options.run.device = torch_side().device_from_name(options.device);
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
  train::TrainHooks hooks;
  hooks.progress = log_row;
  hooks.stop = [] { return interrupted.load(); };
  hooks.write_picture = [](const std::filesystem::path& path, const ByteImage& picture) {
    io::write_picture(path, picture);
  };
  const train::TrainReport report = torch_side().train_highlight(options.run, hooks);
  if (options.json) {
    print_json_line({{"finished", report.finished},
                     {"steps", report.rows.empty() ? 0 : report.rows.back().step},
                     {"samples_per_second", report.samples_per_second},
                     {"weights", report.weights.string()}});
  }
  if (!report.finished) spdlog::warn("stopped; the same command goes on from the last checkpoint");
  return 0;
}

}  // namespace

void add_train(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("train", "trains a network on synthetic faces");
  command->add_option("NET", options->net, "which network; gardner, legendre and sky are rivals to measure against")
      ->required()
      ->check(CLI::IsMember(kNets));
  command->add_option("--config", options->config, "training config, JSON; default: the built-in one")
      ->check(CLI::ExistingFile);
  command->add_option("--data", options->run.data, "folder that `faceprobe synth` wrote; of maps for gardner and sky")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--more", options->run.more_data,
                   "highlight, face and light: further such folders, learnt from as well; default: none")
      ->type_name("DIR");
  command
      ->add_option("--validation", options->run.validation_data,
                   "such a folder of other people or maps, to measure on; default: nothing is measured")
      ->type_name("DIR");
  command
      ->add_option(
          "--scenes", options->scenes,
          "gardner and sky: tables of the maps' scenes, CSV with columns name, folder and scene; gardner then learns "
          "from the indoor ones, sky from those that are outdoor and by day; default: from all")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->add_option("--start", options->run.start, "weights to begin with; default: drawn at random")
      ->type_name("FILE");
  command->add_option("-o,--output", options->run.folder, "folder for checkpoint, log, pictures and weights")
      ->type_name("DIR")
      ->required();
  command->add_option("--device", options->device, "what computes; cuda:N is one of several cards")
      ->type_name("{auto,cpu,cuda}")
      ->capture_default_str();
  command->add_option("--threads", options->run.threads, "threads; 0 = all processors")->capture_default_str();
  command
      ->add_option("--workers", options->run.workers,
                   "threads that make samples ready; 0 = one beside a processor, more beside a card")
      ->capture_default_str();
  command
      ->add_option("--stop-after", options->run.stop_after,
                   "step to end at, with the learning rate of a run that goes on; 0 = the config's last")
      ->type_name("STEPS")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--repeat-batch", options->run.repeat_batch,
                    "train on one batch again and again and save nothing: the speed without data");
  command->add_flag("--json", options->json, "one JSON object on stdout at the end");
  command->footer(
      "An interrupted run of highlight or face goes on bit for bit when the same command is given again; the others "
      "begin anew.\n\n"
      "Example:\n"
      "  faceprobe train highlight --config models/highlight.json --data faces/train --validation faces/dev -o run");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
