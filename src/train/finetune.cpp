#include "faceprobe/train/finetune.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"

#include "net/torch/weights.h"
#include "train/descent.h"
#include "train/finetune_model.h"
#include "train/finetune_people.h"
#include "train/finetune_score.h"
#include "train/finetune_state.h"
#include "train/finetune_step.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kFinetuneRowEvery = 10;  // steps

// Of the synthetic faces: drawn, changed and judged as those that the weights were trained on.
TrainConfig faces_config_of(const FinetuneRun& run) {
  TrainConfig config = trained_config(run.start);
  if (run.config.synthetic_batch > 0) config.batch = run.config.synthetic_batch;
  config.seed = run.config.seed;
  config.steps = run.config.steps;
  config.validation_samples = run.config.validation_samples;
  return config;
}

std::optional<synth::ShardReader> faces_in(const std::filesystem::path& folder, const TrainConfig& config) {
  std::optional<synth::ShardReader> faces(folder);
  require_meshes(*faces, folder, config);
  return faces;
}

DescentOptions finetune_descent(const FinetuneConfig& config) {
  return {.schedule = {.peak = config.learning_rate, .steps = config.steps, .warm_up = 0, .final_share = 0.01},
          .weight_decay = 0,
          .largest_gradient = config.largest_gradient,
          .average_decay = config.ema,
          .averaged = Averaged::kParameters,
          .seed = config.seed};
}

class Finetuning {
 public:
  Finetuning(const FinetuneRun& run, const FinetuneHooks& hooks)
      : run_(run), hooks_(hooks), people_(split_people(run.people, run.config.seed, run.config.held_out_share)),
        faces_config_(faces_config_of(run)), model_(load_model(run.start)), before_(load_model(run.start)),
        descent_(model_.module, finetune_descent(run.config)) {
    before_.module->eval();
    model_.module->train();
    if (run.config.synthetic_batch > 0) faces_ = faces_in(run.synthetic, faces_config_);
    std::optional<synth::ShardReader> validation;
    if (!run.validation.empty()) validation = faces_in(run.validation, faces_config_);
    identity_ = identity(validation);
    io::create_folder(run.folder);
    Checkpoint saved = to_checkpoint({});
    if (load_checkpoint(checkpoint_path(), saved, descent_, identity_)) state_ = from_checkpoint(saved);
    io::write_file_atomically(run.folder / "config.json", to_json(run.config));
    scorer_.emplace(run.config, people_.held_out, validation ? &*validation : nullptr, faces_config_);
  }

  FinetuneReport go() {
    const FinetuneConfig& config = run_.config;
    if (state_.scores.empty()) {
      score();
      save();
    }
    FinetuneStep source(config, model_, before_, people_.trained, faces_ ? &*faces_ : nullptr, faces_config_,
                        state_.step);
    bool stopped = false;
    while (state_.step < config.steps) {
      if (hooks_.stop && hooks_.stop()) {
        stopped = true;
        save();
        break;
      }
      one_step(source);
      const bool last = state_.step == config.steps;
      if (last || state_.step % kFinetuneRowEvery == 0) tell_row();
      const bool scored = last || (config.score_every > 0 && state_.step % config.score_every == 0);
      if (scored) score();
      if (scored || state_.step % config.save_every == 0) save();
    }
    return report(!stopped);
  }

 private:
  bool validated() const { return !run_.validation.empty(); }
  std::size_t kept() const { return kept_score(state_.scores, run_.config.max_validation_rise); }
  std::filesystem::path checkpoint_path() const { return run_.folder / "checkpoint.pt"; }
  std::filesystem::path weights_path() const { return run_.folder / "weights.safetensors"; }

  // What the checkpoint has to agree with.
  std::string identity(const std::optional<synth::ShardReader>& validation) const {
    const auto recipe = [](const std::optional<synth::ShardReader>& faces) {
      return faces ? Json::parse(faces->recipe()) : Json();
    };
    Json people = Json::array();
    for (const PersonSet& person : run_.people)
      people.push_back({person.name, person.photos.size(), person.calibrated});
    const Json json = {{"config", Json::parse(to_json(run_.config))},
                       {"people", people},
                       {"data", recipe(faces_)},
                       {"validation", recipe(validation)},
                       {"start", net::read_model_info(run_.start).sha256}};
    return json.dump(1, ' ', false, Json::error_handler_t::replace);
  }

  void one_step(FinetuneStep& source) {
    descent_.begin(state_.step);
    const StepLoss loss = source.add_gradients(state_.step);
    descent_.end(state_.step, loss.whole);
    ++state_.step;
    state_.people_steps += loss.people ? 1 : 0;
    state_.sum.residual += loss.parts.residual;
    state_.sum.energy += loss.parts.energy;
    state_.sum.guards += loss.parts.guards;
    state_.sum.synthetic_loss += loss.parts.synthetic_loss;
  }

  void tell_row() {
    add_row(state_);
    io::write_file_atomically(run_.folder / "log.csv", to_csv(state_.rows));
    if (hooks_.progress) hooks_.progress(state_.rows.back(), run_.config.steps);
  }

  // Of the averaged weights, which are kept if they are to be.
  void score() {
    const AveragedWeights averaged(descent_.average(), *model_.module);
    FinetuneScore found = scorer_->measure(model_);
    found.step = state_.step;
    state_.scores.push_back(found);
    if (hooks_.scored) hooks_.scored(found);
    if (kept() + 1 == state_.scores.size()) keep();
    io::write_file_atomically(run_.folder / "scores.csv", to_csv(state_.scores, run_.config.max_validation_rise));
  }

  void keep() {
    const Json json = {{"config", Json::parse(to_json(run_.config))},
                       {"step", state_.step},
                       {"people", people_.trained.size()},
                       {"start", net::read_model_info(run_.start).sha256}};
    std::map<std::string, std::string> metadata = model_.metadata;
    metadata["finetune"] = json.dump(1);
    net::save_weights(*model_.module, weights_path(), metadata, true);
    if (!hooks_.write_picture) return;
    hooks_.write_picture(run_.folder / "people.png", scorer_->people_picture(before_, model_));
    if (validated()) hooks_.write_picture(run_.folder / "validation.png", scorer_->faces_picture(model_));
  }

  void save() {
    save_checkpoint(checkpoint_path(), to_checkpoint(state_), descent_, identity_);
    if (hooks_.write_picture) hooks_.write_picture(run_.folder / "curves.png", draw_curves(state_, validated()));
  }

  FinetuneReport report(bool finished) const {
    FinetuneReport report;
    report.scores = state_.scores;
    report.rows = state_.rows;
    report.before = state_.scores.front();
    report.after = state_.scores[kept()];
    report.weights = weights_path();
    report.steps = run_.config.steps;
    report.max_validation_rise = run_.config.max_validation_rise;
    report.validated = validated();
    report.finished = finished;
    return report;
  }

  const FinetuneRun& run_;
  const FinetuneHooks& hooks_;
  SplitPeople people_;
  TrainConfig faces_config_;
  Model model_;
  Model before_;
  Descent descent_;
  std::optional<synth::ShardReader> faces_;
  std::optional<FinetuneScorer> scorer_;
  std::string identity_;
  FinetuneState state_;
};

}  // namespace

FinetuneReport finetune_highlight(const FinetuneRun& run, const FinetuneHooks& hooks) {
  if (const std::string fault = run.config.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  return Finetuning(run, hooks).go();
}

}  // namespace faceprobe::train
