#include "faceprobe/train/train_regressor.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/permutation.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"
#include "net/torch/weights.h"
#include "train/regressor_data.h"
#include "train/regressor_task.h"
#include "train/schedule.h"
#include "train/weight_average.h"

#include <optional>
#include <sstream>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kSeenAtOnce = 100;      // pictures validated together
constexpr std::int64_t kSeenAfterEpoch = 320;  // of the training data
constexpr int kValidationCrops = 16;           // of a map
constexpr int kValidationFaces = 1000;
constexpr std::uint64_t kTrainingKey = 0x7A1;  // of what is drawn for examples
constexpr std::uint64_t kValidationKey = 0xDE7;

// N x 3 x px x px, 0 .. 1, channels-last in memory.
torch::Tensor as_input(const torch::Tensor& bytes) {
  constexpr float kWhite = 255;
  return (bytes.to(torch::kFloat) / kWhite).permute({0, 3, 1, 2});
}

class RegressorTraining {
 public:
  RegressorTraining(const RegressorConfig& config, RegressorTask& task, RegressorExamples training,
                    RegressorExamples validation)
      : config_(config), task_(task), training_(std::move(training)), validation_(std::move(validation)) {
    task_.start_at(training_.light);
    average_.emplace(task_.net(), config_.average_decay);
  }

  RegressorRow epoch(int number) {
    const std::int64_t steps = std::max<std::int64_t>(1, training_.count() / config_.batch);
    const std::vector<int> order = permutation(static_cast<int>(training_.count()),
                                               Random({config_.seed, 0x4E6, static_cast<std::uint64_t>(number)}));
    task_.begin_epoch(static_cast<double>(number) / config_.epochs);
    task_.net().train();
    RegressorRow row;
    row.epoch = number + 1;
    for (std::int64_t step = 0; step < steps; ++step) {
      const std::int64_t done = number * steps + step;
      const double share = static_cast<double>(done) / static_cast<double>(config_.epochs * steps);
      set_learning_rate(optimizer_, config_.learning_rate * half_cosine(share, 0));
      torch::manual_seed(config_.seed ^ (static_cast<std::uint64_t>(done) << 20U));
      row.loss += one_step(order, step, done) / static_cast<double>(steps);
    }
    average_->swap(task_.net());
    task_.net().eval();
    const std::int64_t some = std::min(kSeenAfterEpoch, training_.count());
    task_.end_epoch(as_input(training_.picture.narrow(0, 0, some)), training_.light.narrow(0, 0, some));
    row.validation = errors([this](std::int64_t first, std::int64_t count) {
      return task_.radiance(as_input(validation_.picture.narrow(0, first, count)));
    });
    average_->swap(task_.net());
    return row;
  }

  // Of the light that is usual: the mean of all, each over its level and the other way round too, at their usual level.
  RegressorErrors usual() const {
    const torch::Tensor level = task_.balls().level(training_.light);
    const torch::Tensor mean = (training_.light / level).mean(0, true);
    const torch::Tensor light = 0.5 * (mean + mean.index_select(1, task_.points().mirror)) * level.log().mean().exp();
    return errors([&](std::int64_t, std::int64_t count) { return light.expand({count, -1, -1}); });
  }

  void save(const std::filesystem::path& path) {
    average_->swap(task_.net());
    net::save_weights(task_.net(), path,
                      {{net::kArchitectureKey, task_.architecture()},
                       {net::kOptionsKey, task_.options_json()},
                       {"run", to_json(config_)}},
                      true);
    average_->swap(task_.net());
  }

 private:
  double one_step(const std::vector<int>& order, std::int64_t step, std::int64_t done) {
    const std::int64_t first = step * config_.batch;
    const std::int64_t count = std::min<std::int64_t>(config_.batch, training_.count() - first);
    torch::Tensor index = torch::empty({count}, torch::kLong);
    for (std::int64_t i = 0; i < count; ++i)
      index.data_ptr<std::int64_t>()[i] = order[static_cast<std::size_t>(first + i)];
    torch::Tensor picture = training_.picture.index_select(0, index);
    torch::Tensor light = training_.light.index_select(0, index);
    const torch::Tensor turned = torch::rand({count}) < 0.5;  // left and right change places
    picture = torch::where(turned.view({-1, 1, 1, 1}), picture.flip(2), picture);
    light = torch::where(turned.view({-1, 1, 1}), light.index_select(1, task_.points().mirror), light);

    // Another white balance: the colours of a place are not to be learnt by heart.
    const torch::Tensor gain = (config_.colour_jitter * torch::randn({count, 1, 3})).exp();
    const torch::Tensor input = as_input(picture) * gain.pow(1 / net::LightCnnOptions::kGamma).view({count, 3, 1, 1});

    optimizer_.zero_grad();
    const torch::Tensor loss = task_.loss(input.clamp(0, 1), light * gain);
    loss.backward();
    constexpr double kLargestGradient = 1;
    torch::nn::utils::clip_grad_norm_(task_.net().parameters(), kLargestGradient);
    optimizer_.step();
    average_->add(task_.net(), done);
    return loss.item<double>();
  }

  // radiance(first, count) of the validation data.
  template <class Radiance>
  RegressorErrors errors(const Radiance& radiance) const {
    const torch::NoGradGuard no_grad;
    task_.net().eval();
    RegressorErrors sum;
    for (std::int64_t first = 0; first < validation_.count(); first += kSeenAtOnce) {
      const std::int64_t count = std::min(kSeenAtOnce, validation_.count() - first);
      const RegressorErrors part =
          task_.balls().errors(radiance(first, count), validation_.light.narrow(0, first, count));
      const double share = static_cast<double>(count) / static_cast<double>(validation_.count());
      sum.diffuse += share * part.diffuse;
      sum.rough += share * part.rough;
      sum.direction_deg += share * part.direction_deg;
      sum.level += share * part.level;
    }
    return sum;
  }

  RegressorConfig config_;
  RegressorTask& task_;
  RegressorExamples training_, validation_;
  torch::optim::AdamW optimizer_{
      task_.net().parameters(),
      torch::optim::AdamWOptions(config_.learning_rate).betas({0.9, 0.99}).weight_decay(config_.weight_decay)};
  std::optional<WeightAverage> average_;
};

std::string regressor_csv(const RegressorReport& report) {
  std::ostringstream text;
  text << "epoch,loss,diffuse,rough,direction_deg,level\n";
  const auto write = [&](const std::string& name, const std::string& loss, const RegressorErrors& errors) {
    text << name << ',' << loss << ',' << errors.diffuse << ',' << errors.rough << ',' << errors.direction_deg << ','
         << errors.level << '\n';
  };
  for (const RegressorRow& row : report.rows)
    write(std::to_string(row.epoch), std::to_string(row.loss), row.validation);
  write("usual", "", report.usual);
  return text.str();
}

void require_valid(const RegressorRun& run) {
  if (const std::string problem = run.config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
}

RegressorReport trained(const RegressorRun& run, RegressorTask& task, RegressorExamples examples,
                        RegressorExamples validation, const RegressorProgress& progress) {
  RegressorTraining training(run.config, task, std::move(examples), std::move(validation));
  io::create_folder(run.folder);
  io::write_file_atomically(run.folder / "config.json", to_json(run.config));
  RegressorReport report;
  report.usual = training.usual();
  report.weights = run.folder / "weights.safetensors";
  for (int epoch = 0; epoch < run.config.epochs; ++epoch) {
    report.rows.push_back(training.epoch(epoch));
    training.save(report.weights);  // of a run that is cut off there is something
    if (progress) progress(report.rows.back(), run.config.epochs);
  }
  io::write_file_atomically(run.folder / "log.csv", regressor_csv(report));
  return report;
}

}  // namespace

RegressorReport train_gardner(const GardnerData& data, const RegressorRun& run, const RegressorProgress& progress) {
  require_valid(run);
  if (data.training.empty()) {
    throw Error(ExitCode::kInput, "There is no map to learn from. Give at least one; some dozens is usual.");
  }
  const std::unique_ptr<RegressorTask> task = gardner_task(run.config);
  RegressorExamples validation;
  if (!data.validation.empty()) {
    validation = crop_examples(data.validation, kValidationCrops * static_cast<int>(data.validation.size()),
                               kValidationKey, run.config, run.threads);
  }
  return trained(run, *task, crop_examples(data.training, run.config.examples, kTrainingKey, run.config, run.threads),
                 std::move(validation), progress);
}

RegressorReport train_legendre(const LegendreData& data, const RegressorRun& run, const RegressorProgress& progress) {
  require_valid(run);
  const std::unique_ptr<RegressorTask> task = legendre_task(run.config);
  RegressorExamples validation;
  if (!data.validation.empty()) validation = face_examples(data.validation, kValidationFaces, run.config, run.threads);
  return trained(run, *task, face_examples(data.training, run.config.examples, run.config, run.threads),
                 std::move(validation), progress);
}

}  // namespace faceprobe::train
