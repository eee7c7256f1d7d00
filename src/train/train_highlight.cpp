#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"
#include "faceprobe/train/train.h"

#include "net/torch/torch_device.h"
#include "net/torch/weights.h"
#include "net/torch/widen.h"
#include "train/checkpoint.h"
#include "train/descent.h"
#include "train/model.h"
#include "train/to_device.h"
#include "train/train_log.h"
#include "train/validate.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kRowEvery = 50;  // steps
constexpr int kPictureRows = 8;
constexpr int kMostWorkers = 256;
constexpr const char* kRowsTable = "rows";

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

synth::ShardReader data_of_run(const TrainRun& run) {
  if (run.more_data.empty()) {
    synth::ShardReader data(run.data);
    require_meshes(data, run.data, run.config);
    return data;
  }
  std::vector<std::filesystem::path> folders = {run.data};
  folders.insert(folders.end(), run.more_data.begin(), run.more_data.end());
  // Each by itself, so that the sentence names the one that lacks something.
  for (const std::filesystem::path& folder : folders) require_meshes(synth::ShardReader(folder), folder, run.config);
  return synth::ShardReader(folders);
}

// What the checkpoint has to agree with.
std::string run_json(const TrainRun& run, const synth::ShardReader& data) {
  const nlohmann::ordered_json json = {{"config", nlohmann::ordered_json::parse(to_json(run.config))},
                                       {"data", nlohmann::ordered_json::parse(data.recipe())},
                                       {"start", run.start.empty() ? "" : net::read_model_info(run.start).sha256}};
  return json.dump(1);
}

void begin_with(const std::shared_ptr<torch::nn::Module>& module, const std::filesystem::path& weights) {
  if (const auto unet = std::dynamic_pointer_cast<net::UNetImpl>(module)) {
    net::UNet wide(unet);
    net::load_widened(wide, weights);
  } else {
    net::load_weights(*module, weights);
  }
}

Model model_of_run(const TrainRun& run) {
  torch::manual_seed(run.config.seed);
  Model model = make_model(run.config);
  if (!run.start.empty()) begin_with(model.module, run.start);
  model.module->to(net::torch_device(run.device));
  return model;
}

Schedule schedule_of(const TrainConfig& config) {
  return {
      .peak = config.learning_rate, .steps = config.steps, .warm_up = config.warm_up, .final_share = config.final_share};
}

DescentOptions descent_options(const TrainConfig& config) {
  // Shi's network is the one with batch normalisation.
  const bool buffers = config.architecture == net::kShiArchitecture;
  return {.schedule = schedule_of(config),
          .weight_decay = config.weight_decay,
          .largest_gradient = config.largest_gradient,
          .average_decay = config.average_decay,
          .averaged = buffers ? Averaged::kParametersAndBuffers : Averaged::kParameters,
          .seed = config.seed};
}

class Training {
 public:
  Training(const TrainRun& run, const TrainHooks& hooks)
      : run_(run), hooks_(hooks), device_(net::torch_device(run.device)), data_(data_of_run(run)),
        model_(model_of_run(run)), descent_(model_.module, descent_options(run.config)) {
    identity_ = run_json(run, data_);
    if (run.repeat_batch) return;
    io::create_folder(run.folder);
    resume();
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
      loss_sum += one_step(to_device(source.next(), device_));
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
  void resume() {
    Checkpoint saved{.step = 0, .tables = {{kRowsTable, table_of_rows({})}}};
    if (!load_checkpoint(checkpoint_path(), saved, descent_, identity_)) return;
    state_.step = saved.step;
    state_.rows = rows_of_table(saved.tables.at(kRowsTable));
    if (state_.step > last_step()) {
      throw Error(ExitCode::kUsage, "The run in " + run_.folder.string() + " has " + std::to_string(state_.step) +
                                        " steps already and cannot stop after " + std::to_string(last_step()) +
                                        ". Choose a later step or another folder.");
    }
  }

  std::int64_t last_step() const { return run_.stop_after > 0 ? run_.stop_after : run_.config.steps; }
  std::filesystem::path checkpoint_path() const { return run_.folder / "checkpoint.pt"; }
  std::filesystem::path weights_path() const { return run_.folder / "weights.safetensors"; }

  double one_step(const Batch& batch) {
    descent_.begin(state_.step);
    const torch::Tensor loss = model_.loss(batch, run_.config.loss);
    loss.backward();
    const auto value = loss.item<double>();
    descent_.end(state_.step, value);
    return value;
  }

  void add_row(double loss, double samples_per_second) {
    TrainRow row;
    row.step = state_.step;
    row.loss = loss;
    row.learning_rate = learning_rate_at(schedule_of(run_.config), state_.step - 1);
    row.samples_per_second = samples_per_second;
    state_.rows.push_back(row);
  }

  void validate() {
    const AveragedWeights averaged(descent_.average(), *model_.module);
    state_.rows.back().validation = validator_->measure(model_);
    state_.rows.back().validated = true;
    if (hooks_.write_picture)
      hooks_.write_picture(run_.folder / "validation.png", validator_->picture(model_, kPictureRows));
  }

  void report(double steps_per_second) const {
    if (!hooks_.progress) return;
    const double left = static_cast<double>(last_step() - state_.step) / steps_per_second;
    hooks_.progress({state_.rows.back(), last_step(), left});
  }

  void save() {
    save_checkpoint(checkpoint_path(), {state_.step, {{kRowsTable, table_of_rows(state_.rows)}}}, descent_, identity_);
    std::map<std::string, std::string> metadata = model_.metadata;
    metadata["run"] = identity_;
    metadata["step"] = std::to_string(state_.step);
    {
      const AveragedWeights averaged(descent_.average(), *model_.module);
      net::save_weights(*model_.module, weights_path(), metadata, true);
    }
    io::write_file_atomically(run_.folder / "log.csv", to_csv(state_.rows));
    if (hooks_.write_picture) hooks_.write_picture(run_.folder / "curves.png", draw_curves(state_.rows));
  }

  const TrainRun& run_;
  const TrainHooks& hooks_;
  torch::Device device_;
  synth::ShardReader data_;
  Model model_;
  Descent descent_;
  std::optional<synth::ShardReader> validation_data_;
  std::optional<Validator> validator_;
  std::string identity_;
  struct {
    std::int64_t step = 0;
    std::vector<TrainRow> rows;
  } state_;
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
