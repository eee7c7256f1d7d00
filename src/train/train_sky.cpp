#include "faceprobe/train/train_sky.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/permutation.h"
#include "faceprobe/core/sun_bins.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/sky_regressor.h"

#include "net/torch/sky_cnn.h"
#include "net/torch/weights.h"
#include "train/schedule.h"
#include "train/sky_examples.h"

#include <algorithm>
#include <sstream>

namespace faceprobe::train {
namespace {

constexpr std::uint64_t kTrainingViews = 0x5c1, kValidationViews = 0x5c2, kOrder = 0x5c3;
constexpr std::int64_t kCropsAtOnce = 128;  // crops validated together
constexpr double kNearDeg = 45;             // degrees: the mark that outdoor estimates are measured by

net::SkyCnnOptions sky_cnn_options(const SkyConfig& config) {
  return {.px = config.px, .widths = config.widths, .hidden = config.hidden};
}

SkyExamples training_examples(const SkyRun& run) {
  if (run.maps.empty())
    throw Error(ExitCode::kInput, "There are no maps to learn skies from. Give maps of outdoor places, their +y up.");
  return draw_sky_examples(run.maps, run.config, kTrainingViews, run.threads);
}

Eigen::Vector3d row_of(const torch::Tensor& vectors, std::int64_t i) {
  return Eigen::Map<const Eigen::Vector3f>(vectors.data_ptr<float>() + 3 * i).cast<double>();
}

void set_angles(SkyErrors& errors, std::vector<double> angles) {
  if (angles.empty()) return;
  std::ranges::sort(angles);
  const std::size_t half = angles.size() / 2;
  errors.median_deg = angles.size() % 2 == 1 ? angles[half] : (angles[half - 1] + angles[half]) / 2;
  const auto near = std::ranges::count_if(angles, [](double angle) { return angle <= kNearDeg; });
  errors.within_45 = static_cast<double>(near) / static_cast<double>(angles.size());
}

class SkyTraining {
 public:
  explicit SkyTraining(const SkyRun& run)
      : config_(run.config), data_(training_examples(run)), net_(make_net(run.config)),
        validation_(draw_sky_examples(run.validation_maps, run.config, kValidationViews, run.threads)) {
    for (int bin = 0; bin < kSunBins; ++bin)
      Eigen::Map<Eigen::Vector3f>(bins_.data_ptr<float>() + 3 * bin) = sun_bin_direction(bin).cast<float>();
    net_->standardise(data_.numbers, data_.ground_albedo);
  }

  SkyRow epoch(int number) {
    const std::int64_t steps = std::max<std::int64_t>(1, data_.count() / config_.batch);
    const std::vector<int> order = permutation(static_cast<int>(data_.count()),
                                               Random({config_.seed, kOrder, static_cast<std::uint64_t>(number)}));
    SkyRow row;
    row.epoch = number + 1;
    net_->train();
    for (std::int64_t step = 0; step < steps; ++step) {
      const std::int64_t done = number * steps + step;
      const double share = static_cast<double>(done) / static_cast<double>(config_.epochs * steps);
      set_learning_rate(optimizer_, config_.learning_rate * half_cosine(share, 0));
      torch::manual_seed(config_.seed ^ (static_cast<std::uint64_t>(done) << 20U));
      const Terms terms = one_step(batch(order, step));
      row.training.sun += terms.sun.item<double>() / static_cast<double>(steps);
      row.training.numbers += terms.numbers.item<double>() / static_cast<double>(steps);
    }
    if (validation_.count() > 0) row.validation = measure();
    return row;
  }

  // Always the same place: the mean of the training's suns.
  SkyErrors guess() const {
    SkyErrors errors;
    if (validation_.count() == 0) return errors;
    const torch::Tensor mean = data_.sun.mean(0, true);
    std::vector<double> angles;
    for (std::int64_t i = 0; i < validation_.count(); ++i)
      angles.push_back(angle_between_deg(row_of(validation_.sun, i), row_of(mean, 0)));
    set_angles(errors, angles);
    return errors;
  }

  void save(const std::filesystem::path& path) const {
    net::save_weights(*net_, path,
                      {{net::kArchitectureKey, net::kSkyArchitecture},
                       {net::kOptionsKey, net::options_json(net_->options())},
                       {"run", to_json(config_)}},
                      false);
  }

 private:
  struct Batch {
    torch::Tensor pictures, sun, numbers;
  };
  struct Terms {
    torch::Tensor sun, numbers;
  };

  static net::SkyCnn make_net(const SkyConfig& config) {
    torch::manual_seed(config.seed);
    return net::SkyCnn(sky_cnn_options(config));
  }

  static Batch examples_at(const SkyExamples& from, const torch::Tensor& index) {
    return {from.pictures.index_select(0, index).permute({0, 3, 1, 2}).to(torch::kFloat32) / 255,
            from.sun.index_select(0, index), from.numbers.index_select(0, index)};
  }

  Batch batch(const std::vector<int>& order, std::int64_t step) const {
    const std::int64_t first = step * config_.batch;
    const std::int64_t count = std::min<std::int64_t>(config_.batch, data_.count() - first);
    torch::Tensor index = torch::empty({count}, torch::kLong);
    for (std::int64_t i = 0; i < count; ++i)
      index.data_ptr<std::int64_t>()[i] = order[static_cast<std::size_t>(first + i)];
    Batch out = examples_at(data_, index);
    const torch::Tensor turned = torch::rand({count}) < 0.5;
    out.pictures = torch::where(turned.view({-1, 1, 1, 1}), out.pictures.flip(3), out.pictures);
    out.sun = torch::where(turned.view({-1, 1}), out.sun * torch::tensor({-1.0F, 1.0F, 1.0F}), out.sun);
    const torch::Tensor gain = (config_.colour_spread * torch::randn({count, 3, 1, 1})).exp();
    out.pictures = (out.pictures * gain).clamp(0, 1);
    return out;
  }

  Terms terms_of(const Batch& batch, double drop) {
    const net::SkyCnnImpl::Output found = net_->forward(batch.pictures, drop);
    const torch::Tensor truth = (config_.sun_concentration * torch::matmul(batch.sun, bins_.t())).softmax(1);
    const torch::Tensor divergence = torch::kl_div(found.sun.log_softmax(1), truth, at::Reduction::Sum);
    return {divergence / batch.sun.size(0), (found.numbers - net_->standardised(batch.numbers)).square().mean()};
  }

  Terms one_step(const Batch& batch) {
    optimizer_.zero_grad();
    Terms terms = terms_of(batch, config_.drop);
    (terms.sun + config_.numbers_weight * terms.numbers).backward();
    constexpr double kLargestGradient = 5;
    torch::nn::utils::clip_grad_norm_(net_->parameters(), kLargestGradient);
    optimizer_.step();
    return terms;
  }

  SkyErrors measure() {
    const torch::NoGradGuard no_grad;
    net_->eval();
    SkyErrors errors;
    std::vector<double> angles;
    for (std::int64_t first = 0; first < validation_.count(); first += kCropsAtOnce) {
      const std::int64_t count = std::min(kCropsAtOnce, validation_.count() - first);
      const Batch part = examples_at(validation_, torch::arange(first, first + count));
      const Terms terms = terms_of(part, 0);
      const double share = static_cast<double>(count) / static_cast<double>(validation_.count());
      errors.sun += share * terms.sun.item<double>();
      errors.numbers += share * terms.numbers.item<double>();
      const torch::Tensor shares = net_->forward(part.pictures).sun.softmax(1).contiguous();
      for (std::int64_t i = 0; i < count; ++i) {
        const Eigen::Map<const Eigen::VectorXf> of_bins(shares.data_ptr<float>() + kSunBins * i, kSunBins);
        angles.push_back(angle_between_deg(row_of(part.sun, i), net::sun_of_shares(of_bins)));
      }
    }
    set_angles(errors, angles);
    return errors;
  }

  SkyConfig config_;
  SkyExamples data_;
  net::SkyCnn net_;
  SkyExamples validation_;
  torch::Tensor bins_ = torch::empty({kSunBins, 3});
  torch::optim::AdamW optimizer_{net_->parameters(),
                                 torch::optim::AdamWOptions(config_.learning_rate).weight_decay(config_.weight_decay)};
};

std::string sky_log(const std::vector<SkyRow>& rows) {
  std::ostringstream text;
  text << "epoch,sun,numbers,validation_sun,validation_numbers,validation_median_deg,validation_within_45\n";
  for (const SkyRow& row : rows) {
    text << row.epoch << ',' << row.training.sun << ',' << row.training.numbers << ',' << row.validation.sun << ','
         << row.validation.numbers << ',' << row.validation.median_deg << ',' << row.validation.within_45 << '\n';
  }
  return text.str();
}

}  // namespace

SkyReport train_sky(const SkyRun& run, const std::function<void(const SkyRow&, int)>& progress) {
  if (const std::string problem = run.config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  SkyTraining training(run);
  io::create_folder(run.folder);
  io::write_file_atomically(run.folder / "config.json", to_json(run.config));
  SkyReport report;
  for (int epoch = 0; epoch < run.config.epochs; ++epoch) {
    report.rows.push_back(training.epoch(epoch));
    if (progress) progress(report.rows.back(), run.config.epochs);
  }
  report.validation = report.rows.back().validation;
  report.guess = training.guess();
  report.weights = run.folder / "weights.safetensors";
  training.save(report.weights);
  io::write_file_atomically(run.folder / "log.csv", sky_log(report.rows));
  return report;
}

}  // namespace faceprobe::train
