#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"
#include "faceprobe/train/train.h"

#include "net/torch/torch_device.h"
#include "net/torch/weights.h"
#include "net/torch/widen.h"
#include "train/channels_last.h"
#include "train/checkpoint.h"
#include "train/model.h"
#include "train/schedule.h"
#include "train/to_device.h"
#include "train/validate.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kRowEvery = 50;  // steps
constexpr int kPictureRows = 8;
constexpr int kMostWorkers = 256;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// What the checkpoint has to agree with.
std::string run_json(const TrainRun& run, const synth::ShardReader& data) {
  const nlohmann::ordered_json json = {{"config", nlohmann::ordered_json::parse(to_json(run.config))},
                                       {"data", nlohmann::ordered_json::parse(data.recipe())},
                                       {"start", run.start.empty() ? "" : net::read_model_info(run.start).sha256}};
  return json.dump(1);
}

class Training {
 public:
  Training(const TrainRun& run, const TrainHooks& hooks)
      : run_(run), hooks_(hooks), device_(net::torch_device(run.device)), data_(run.data),
        model_(make_seeded(run.config)), average_(*model_.module, run.config.average_decay, averaged()),
        optimizer_(
            model_.module->parameters(),
            torch::optim::AdamWOptions(run.config.learning_rate).betas({0.9, 0.99}).weight_decay(run.config.weight_decay)) {
    if (!run.start.empty()) {
      begin_with(run.start);
      average_ = WeightAverage(*model_.module, run.config.average_decay, averaged());
    }
    model_.module->to(device_);
    for (torch::Tensor& value : average_.values()) value = value.to(device_);
    require_meshes(data_, run.data, run.config);
    identity_ = run_json(run, data_);
    if (run.repeat_batch) return;
    io::create_folder(run.folder);
    load_checkpoint(checkpoint_path(), state_, *model_.module, optimizer_, average_, identity_);
    if (state_.step > last_step()) {
      throw Error(ExitCode::kUsage, "The run in " + run.folder.string() + " has " + std::to_string(state_.step) +
                                        " steps already and cannot stop after " + std::to_string(last_step()) +
                                        ". Choose a later step or another folder.");
    }
    to_channels_last(*model_.module);  // a checkpoint from before the weights were so
    io::write_file_atomically(run.folder / "config.json", to_json(run.config));
    if (!run.validation_data.empty()) {
      validation_data_.emplace(run.validation_data);
      require_meshes(*validation_data_, run.validation_data, run.config);
      validator_.emplace(*validation_data_, run.config, device_);
    }
  }

  TrainReport go() {
    const TrainConfig& config = run_.config;
    const int workers = run_.workers > 0 ? run_.workers : usual_workers(!device_.is_cpu());
    BatchSource source(data_, config, state_.step, run_.repeat_batch, workers);
    const std::int64_t first = state_.step;
    double busy = 0;  // seconds in steps and in waiting for data
    double since = now();
    double loss_sum = 0;
    std::int64_t counted = 0;
    bool stopped = false;
    const std::int64_t end = last_step();
    while (state_.step < end) {
      if (hooks_.stop && hooks_.stop()) {
        stopped = true;
        break;
      }
      const double loss = one_step(to_device(source.next(), device_));
      if (!std::isfinite(loss)) {
        throw Error(ExitCode::kUnexpected, "The loss is no number any more after step " + std::to_string(state_.step) +
                                               "; lower the learning rate. The last checkpoint is from before that.");
      }
      loss_sum += loss;
      ++counted;
      ++state_.step;
      const bool last = state_.step == end;
      if (state_.step % kRowEvery == 0 || last) {
        const double seconds = now() - since;
        busy += seconds;
        add_row(loss_sum / static_cast<double>(counted), static_cast<double>(counted * config.batch) / seconds);
        if (validator_ && (state_.step % config.validate_every < kRowEvery || last)) validate();
        report(static_cast<double>(state_.step - first) / busy);
        loss_sum = 0;
        counted = 0;
        if (!run_.repeat_batch && (state_.step % config.save_every < kRowEvery || last)) save();
        since = now();
      }
    }
    TrainReport result;
    result.rows = state_.rows;
    result.finished = !stopped;
    result.weights = weights_path();
    if (busy > 0) result.samples_per_second = static_cast<double>((state_.step - first) * config.batch) / busy;
    return result;
  }

 private:
  static Model make_seeded(const TrainConfig& config) {
    torch::manual_seed(config.seed);
    return make_model(config);
  }

  // Shi's network is the one with batch normalisation.
  Averaged averaged() const {
    return run_.config.architecture == net::kShiArchitecture ? Averaged::kParametersAndBuffers : Averaged::kParameters;
  }

  void begin_with(const std::filesystem::path& weights) {
    if (const auto unet = std::dynamic_pointer_cast<net::UNetImpl>(model_.module)) {
      net::UNet wide(unet);
      net::load_widened(wide, weights);
    } else {
      net::load_weights(*model_.module, weights);
    }
  }

  std::int64_t last_step() const { return run_.stop_after > 0 ? run_.stop_after : run_.config.steps; }
  std::filesystem::path checkpoint_path() const { return run_.folder / "checkpoint.pt"; }
  std::filesystem::path weights_path() const { return run_.folder / "weights.safetensors"; }

  double one_step(const Batch& batch) {
    const TrainConfig& config = run_.config;
    // Dropout depends on the seed and the step alone, so that a resumed run drops the same.
    torch::manual_seed(config.seed ^ (static_cast<std::uint64_t>(state_.step) << 20U));
    set_learning_rate(optimizer_, learning_rate_at(config, state_.step));
    optimizer_.zero_grad();
    const torch::Tensor loss = model_.loss(batch, config.loss);
    loss.backward();
    torch::nn::utils::clip_grad_norm_(model_.module->parameters(), config.largest_gradient);
    optimizer_.step();
    average_.add(*model_.module, state_.step);
    return loss.item<double>();
  }

  void add_row(double loss, double samples_per_second) {
    TrainRow row;
    row.step = state_.step;
    row.loss = loss;
    row.learning_rate = learning_rate_at(run_.config, state_.step - 1);
    row.samples_per_second = samples_per_second;
    state_.rows.push_back(row);
  }

  void validate() {
    average_.swap(*model_.module);
    state_.rows.back().validation = validator_->measure(model_);
    state_.rows.back().validated = true;
    if (hooks_.write_picture)
      hooks_.write_picture(run_.folder / "validation.png", validator_->picture(model_, kPictureRows));
    average_.swap(*model_.module);
  }

  void report(double steps_per_second) const {
    if (!hooks_.progress) return;
    const double left = static_cast<double>(last_step() - state_.step) / steps_per_second;
    hooks_.progress({state_.rows.back(), last_step(), left});
  }

  void save() {
    save_checkpoint(checkpoint_path(), state_, *model_.module, optimizer_, average_, identity_);
    std::map<std::string, std::string> metadata = model_.metadata;
    metadata["run"] = identity_;
    metadata["step"] = std::to_string(state_.step);
    average_.swap(*model_.module);
    net::save_weights(*model_.module, weights_path(), metadata, true);
    average_.swap(*model_.module);
    io::write_file_atomically(run_.folder / "log.csv", to_csv(state_.rows));
    if (hooks_.write_picture) hooks_.write_picture(run_.folder / "curves.png", draw_curves(state_.rows));
  }

  const TrainRun& run_;
  const TrainHooks& hooks_;
  torch::Device device_;
  synth::ShardReader data_;
  Model model_;
  WeightAverage average_;
  torch::optim::AdamW optimizer_;
  std::optional<synth::ShardReader> validation_data_;
  std::optional<Validator> validator_;
  std::string identity_;
  Checkpoint state_;
};

}  // namespace

TrainReport train_highlight(const TrainRun& run, const TrainHooks& hooks) {
  if (const std::string problem = run.config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  if (run.stop_after < 0 || run.stop_after > run.config.steps) {
    throw Error(ExitCode::kUsage, "The run is to stop after " + std::to_string(run.stop_after) +
                                      " steps; allowed is 1 to the config's " + std::to_string(run.config.steps) +
                                      ", and 0 for all of them.");
  }
  if (run.workers < 0 || run.workers > kMostWorkers) {
    throw Error(ExitCode::kUsage, "The run is to have " + std::to_string(run.workers) + " workers; allowed is 1 to " +
                                      std::to_string(kMostWorkers) + ", and 0 for what the device can use.");
  }
  if (run.config.precision == "bf16" && !run.device.cuda) {
    throw Error(ExitCode::kUsage,
                "The training config's precision is bf16, which is for a card, and the run is on the processor. Give "
                "float32, or --device cuda.");
  }
  net::require_device(run.device);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  return Training(run, hooks).go();
}

}  // namespace faceprobe::train
