#include "commands.h"
#include "json_line.h"
#include "torch_side.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <memory>

namespace faceprobe::cli {

namespace {

struct SurfaceOptions {
  std::string people, same_light;
  std::string start;
  std::string synthetic, validation;
  std::string output;
  int most_people = 64;
  bool json = false;
  train::PeopleOptions photos{.match_colours = false};
  train::FinetuneSurfaceConfig config;
};

std::atomic<bool> surface_interrupted = false;

void print_table(const train::FinetuneSurfaceReport& report) {
  fmt::print(
      "{} people held out\n\n| | re-rendering residual | albedo apart | contrast of shading | confidence | normals "
      "moved, deg |\n| --- | ---: | ---: | ---: | ---: | ---: |\n",
      report.before.people);
  const auto row = [](const char* name, const train::SurfaceScore& score) {
    fmt::print("| {} | {:.4f} | {:.4f} | {:.3f} | {:.3f} | {:.2f} |\n", name, score.residual, score.albedo,
               score.contrast, score.confidence, score.normal_change_deg);
  };
  row("before", report.before);
  row("after", report.after);
  if (!report.validated) return;
  fmt::print(
      "\nOn synthetic faces:\n\n| | normals, deg | shading, log | colour of light, deg | regions right | highlight on "
      "skin, 0-255 "
      "|\n| --- | ---: | ---: | ---: | ---: | ---: |\n");
  const auto dev = [](const char* name, const train::Validation& errors) {
    fmt::print("| {} | {:.2f} | {:.4f} | {:.2f} | {:.4f} | {:.2f} |\n", name, errors.normal_deg, errors.shading,
               errors.colour_deg, errors.region_share, errors.skin);
  };
  dev("before", report.dev_before);
  dev("after", report.dev_after);
}

void print_json(const train::FinetuneSurfaceReport& report, std::chrono::duration<double> taken) {
  const auto row = [&](const train::SurfaceScore& score, const train::Validation& errors) {
    nlohmann::ordered_json json = {{"residual", score.residual},
                                   {"albedo_apart", score.albedo},
                                   {"contrast", score.contrast},
                                   {"confidence", score.confidence},
                                   {"normal_change_deg", score.normal_change_deg}};
    if (!report.validated) return json;
    json["synthetic"] = {{"normal_deg", errors.normal_deg},
                         {"shading", errors.shading},
                         {"colour_deg", errors.colour_deg},
                         {"region_share", errors.region_share},
                         {"highlight_skin", errors.skin}};
    return json;
  };
  print_json_line({{"finished", report.finished},
                   {"steps", report.rows.empty() ? 0 : report.rows.back().step},
                   {"people_held_out", report.before.people},
                   {"before", row(report.before, report.dev_before)},
                   {"after", row(report.after, report.dev_after)},
                   {"weights", report.weights.string()},
                   {"seconds", taken.count()}});
}

train::FinetuneSurfaceRun run_of(SurfaceOptions options) {
  train::FinetuneSurfaceRun run;
  options.photos.least_photos = options.config.photos;
  options.photos.most_photos = std::max(options.photos.most_photos, options.config.photos);
  const auto log = [](const std::string& text) { spdlog::info("{}", text); };
  run.people = std::filesystem::exists(std::filesystem::path(options.people) / "index.json")
                   ? train::load_synthetic_people(options.people, options.most_people, options.photos, log)
                   : train::load_people(options.people, options.photos, log);
  if (!options.same_light.empty()) {
    train::PeopleOptions anybody = options.photos;
    anybody.least_photos = 2;
    anybody.most_photos = std::numeric_limits<int>::max();
    anybody.max_light_colours = 1;  // told from a person's other photos, which these are not
    run.lights = train::load_people(options.same_light, anybody, log);
  }
  run.config = options.config;
  run.start = options.start;
  run.synthetic = options.synthetic;
  run.validation = options.validation;
  run.folder = options.output;
  run.threads = options.photos.threads;
  return run;
}

int run(const SurfaceOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const train::FinetuneSurfaceRun run = run_of(options);
  std::signal(SIGINT, [](int) { surface_interrupted = true; });
  std::signal(SIGTERM, [](int) { surface_interrupted = true; });
  train::FinetuneSurfaceHooks hooks;
  hooks.progress = [](const train::SurfaceRow& row, std::int64_t steps) {
    spdlog::info(
        "step {} of {}: residual {:.4f}, albedo {:.4f}, under one light {:.4f}, guards {:.4f}, loss on synthetic faces "
        "{:.5f}",
        row.step, steps, row.residual, row.albedo, row.lights, row.guards, row.synthetic_loss);
  };
  hooks.stop = [] { return surface_interrupted.load(); };
  const train::FinetuneSurfaceReport report = torch_side().finetune_surface(run, hooks);
  if (options.json) {
    print_json(report, std::chrono::steady_clock::now() - start);
  } else {
    print_table(report);
  }
  return 0;
}

void add_files(CLI::App& command, SurfaceOptions& options) {
  command
      .add_option("--people", options.people,
                  "folder with one folder of photos a person, at any depth, or one that `faceprobe synth` wrote")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      .add_option("--same-light", options.same_light,
                  "folder whose folders each hold photos of anybody under the same lights; default: none")
      ->check(CLI::ExistingDirectory);
  command.add_option("--start", options.start, "weights of a network face to begin with")->type_name("FILE")->required();
  command
      .add_option("--data", options.synthetic,
                  "folder that `faceprobe synth` and `faceprobe mesh` wrote, for every step's synthetic faces")
      ->type_name("DIR")
      ->required();
  command
      .add_option("--validation", options.validation,
                  "the same to measure errors on, before and after; default: no errors are measured")
      ->type_name("DIR");
  command.add_option("-o,--output", options.output, "folder for weights and log")->type_name("DIR")->required();
}

void add_photo_options(CLI::App& command, SurfaceOptions& options) {
  command.add_option("--photos", options.config.photos, "photos of one person, or of one light, in a step")
      ->capture_default_str();
  command.add_option("--most-photos", options.photos.most_photos, "photos of one person at all")->capture_default_str();
  command
      .add_option("--max-expression", options.photos.max_expression,
                  "error of the rigid mean face per width of the face, above which a photo is left out")
      ->capture_default_str();
  command
      .add_option("--max-light-colours", options.photos.max_light_colours,
                  "spread of chromaticity of the light on the skin, above which a photo is left out")
      ->capture_default_str();
  command.add_flag("--calibrate", options.photos.calibrate,
                   "decode each photo by the response curve that its skin tells of; default: as sRGB");
  command.add_option("--most-people", options.most_people, "synthetic people at all")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command.add_option("--held-out", options.config.held_out_share, "share of the people to measure on")
      ->capture_default_str();
}

void add_loss_options(CLI::App& command, train::FinetuneSurfaceConfig& config) {
  train::RerenderOptions& rerender = config.rerender;
  command.add_option("--steps", config.steps, "steps of training")->capture_default_str();
  command.add_option("--synthetic-batch", config.synthetic_batch, "synthetic faces in a step")->capture_default_str();
  command.add_option("--learning-rate", config.learning_rate, "learning rate of AdamW")->capture_default_str();
  command.add_option("--weight", config.weight, "weight of the photos' loss against that on synthetic faces")
      ->capture_default_str();
  command.add_option("--albedo-weight", rerender.albedo_weight, "weight, within it, of a person's albedos being one")
      ->capture_default_str();
  command.add_option("--guard-weight", rerender.guard_weight, "weight, within it, of each guard")->capture_default_str();
  command.add_option("--order", rerender.order, "order of the light's spherical harmonics")->capture_default_str();
  command
      .add_option("--normal-slack", rerender.normal_slack_deg,
                  "degrees that normals may leave the first network's at no cost")
      ->capture_default_str();
  command
      .add_option("--contrast-slack", rerender.contrast_slack,
                  "share of its contrast that the shading may lose or gain at no cost")
      ->capture_default_str();
}

}  // namespace

void add_finetune_surface(CLI::App& program, Action& action) {
  auto options = std::make_shared<SurfaceOptions>();
  CLI::App* command = program.add_subcommand(
      "finetune-surface", "improves the network's normals and shading on photos of people, several of each");
  add_files(*command, *options);
  add_photo_options(*command, *options);
  add_loss_options(*command, options->config);
  command->add_option("--seed", options->config.seed, "the same seed gives the same run")->capture_default_str();
  command->add_option("--threads", options->photos.threads, "threads; 0 = all processors")->capture_default_str();
  command->add_flag("--json", options->json, "one JSON object on stdout at the end; default: a table");
  command->footer(
      "Normals, albedo, shading and one light must make the photo again, and photos of one person share their "
      "albedo.\nPrints a table of people it was not trained on. Weights inherit the terms of the photos.\n\nExample:\n"
      "  faceprobe finetune-surface --people people --start models/face.safetensors --data faces/train -o surface");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
