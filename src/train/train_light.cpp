#include "faceprobe/train/train_light.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/permutation.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/lighting/face_features.h"
#include "faceprobe/net/light_prior.h"
#include "faceprobe/synth/traced.h"

#include "net/torch/light_mlp.h"
#include "net/torch/weights.h"
#include "train/light_loss.h"
#include "train/schedule.h"
#include "train/weight_average.h"

#include <optional>
#include <sstream>

namespace faceprobe::train {
namespace {

constexpr double kDarkest = 1e-4;               // of the level
constexpr std::int64_t kExamplesAtOnce = 1024;  // examples validated together

struct Examples {
  torch::Tensor features;  // N x inputs
  torch::Tensor light;     // N x cells x 3

  std::int64_t count() const { return features.size(0); }
};

Examples read_examples(const std::filesystem::path& folder) {
  const std::vector<synth::TracedPhoto> photos = synth::read_traced(folder);
  if (photos.empty()) {
    throw Error(ExitCode::kInput, "There is nothing in " + folder.string() +
                                      " that an estimate read from its photos. Run `faceprobe trace " +
                                      folder.string() + "` first.");
  }
  const auto count = static_cast<std::int64_t>(photos.size());
  const std::int64_t inputs = photos[0].features.size();
  const std::int64_t cells = photos[0].light.rows();
  if (inputs != lighting::kFaceFeatures || cells != lighting::kFeatureCells)
    throw Error(ExitCode::kInput,
                "What was read from the photos in " + folder.string() +
                    " is of another version. Remove its traced-*.safetensors and run `faceprobe trace` again.");
  Examples out{torch::empty({count, inputs}), torch::empty({count, cells, 3})};
  for (std::int64_t i = 0; i < count; ++i) {
    const synth::TracedPhoto& photo = photos[static_cast<std::size_t>(i)];
    if (photo.features.size() != inputs || photo.light.rows() != cells || !photo.features.allFinite() ||
        !photo.light.allFinite())
      throw Error(ExitCode::kInput,
                  "What was read from photo " + std::to_string(i) + " in " + folder.string() +
                      " is damaged or of another version. Remove its traced files and run `faceprobe trace` again.");
    std::copy_n(photo.features.data(), inputs, out.features.data_ptr<float>() + i * inputs);
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(out.light.data_ptr<float>() + i * cells * 3,
                                                                         cells, 3) = photo.light;
  }
  out.light.clamp_min_(kDarkest);
  return out;
}

Examples read_all(const LightRun& run) {
  std::vector<torch::Tensor> features, light;
  const auto take = [&](const std::filesystem::path& folder) {
    const Examples examples = read_examples(folder);
    features.push_back(examples.features);
    light.push_back(examples.light);
  };
  take(run.data);
  for (const std::filesystem::path& folder : run.more_data) take(folder);
  return {torch::cat(features), torch::cat(light)};
}

// Where a cell's mirror image is, as an index.
torch::Tensor mirror_index() {
  Eigen::MatrixXf numbers(lighting::kFeatureCells, 1);
  for (int j = 0; j < lighting::kFeatureCells; ++j) numbers(j, 0) = static_cast<float>(j);
  const Eigen::MatrixXf mirrored = lighting::mirrored_cells(numbers);
  torch::Tensor index = torch::empty({lighting::kFeatureCells}, torch::kLong);
  for (int j = 0; j < lighting::kFeatureCells; ++j)
    index.data_ptr<std::int64_t>()[j] = static_cast<std::int64_t>(mirrored(j, 0));
  return index;
}

// Where in a list of features each number of the mirror image's is.
torch::Tensor mirrored_feature_index() {
  Eigen::VectorXf numbers(lighting::kFaceFeatures);
  for (int i = 0; i < lighting::kFaceFeatures; ++i) numbers[i] = static_cast<float>(i);
  const Eigen::VectorXf turned = lighting::mirrored_features(numbers);
  torch::Tensor index = torch::empty({lighting::kFaceFeatures}, torch::kLong);
  for (int i = 0; i < lighting::kFaceFeatures; ++i)
    index.data_ptr<std::int64_t>()[i] = static_cast<std::int64_t>(turned[i]);
  return index;
}

torch::Tensor luminance_weights() {
  return torch::tensor({kLuminanceWeights[0], kLuminanceWeights[1], kLuminanceWeights[2]});
}

// N x anything, in groups of `size` numbers that begin with three square roots of light: grey is the root of the luminance.
torch::Tensor grey_groups(const torch::Tensor& features, std::int64_t size) {
  const torch::Tensor groups = features.reshape({features.size(0), -1, size});
  const torch::Tensor light =
      (groups.narrow(2, 0, 3).square() * luminance_weights()).sum(2, true).sqrt().expand({-1, -1, 3});
  return torch::cat({light, groups.narrow(2, 3, size - 3)}, 2).reshape_as(features);
}

Examples grey(const Examples& examples) {
  const torch::Tensor level = (examples.light * luminance_weights()).sum(2, true).expand_as(examples.light);
  return {torch::cat({grey_groups(examples.features.narrow(1, 0, lighting::kCellFeatures), 4),
                      grey_groups(examples.features.narrow(1, lighting::kCellFeatures, lighting::kSolvedFeatures), 3)},
                     1),
          level.contiguous()};
}

class LightTraining {
 public:
  explicit LightTraining(const LightRun& run)
      : config_(run.config), data_(read_all(run)), mirror_(mirror_index()), mirror_features_(mirrored_feature_index()),
        net_(make_net(run.config)) {
    if (!run.validation_data.empty()) validation_ = read_examples(run.validation_data);
    net_->standardise(data_.features);
    start_at_median();
    average_.emplace(*net_, config_.average_decay);
  }

  LightRow epoch(int number) {
    const std::int64_t steps = std::max<std::int64_t>(1, data_.count() / config_.batch);
    const std::vector<int> order =
        permutation(static_cast<int>(data_.count()), Random({config_.seed, 0x116, static_cast<std::uint64_t>(number)}));
    LightRow row;
    row.epoch = number + 1;
    for (std::int64_t step = 0; step < steps; ++step) {
      const std::int64_t done = number * steps + step;
      const double share = static_cast<double>(done) / static_cast<double>(config_.epochs * steps);
      set_learning_rate(optimizer_, config_.learning_rate * half_cosine(share, 0));
      torch::manual_seed(config_.seed ^ (static_cast<std::uint64_t>(done) << 20U));
      const LightLoss::Terms terms = one_step(batch(order, step), done);
      row.training.diffuse += terms.diffuse.item<double>() / static_cast<double>(steps);
      row.training.shape += terms.shape.item<double>() / static_cast<double>(steps);
      row.training.glossy += terms.glossy.item<double>() / static_cast<double>(steps);
    }
    average_->swap(*net_);
    if (validation_.features.defined()) row.validation = measure(validation_);
    average_->swap(*net_);
    return row;
  }

  void save(const std::filesystem::path& path) {
    average_->swap(*net_);
    net::save_weights(*net_, path,
                      {{net::kArchitectureKey, net::kLightArchitecture},
                       {net::kOptionsKey, net::options_json(net_->options())},
                       {"run", to_json(config_)}},
                      true);
    average_->swap(*net_);
  }

 private:
  static net::LightMlp make_net(const LightConfig& config) {
    torch::manual_seed(config.seed);
    return net::LightMlp(net::LightOptions{
        .inputs = lighting::kFaceFeatures, .hidden = config.hidden, .outputs = 3 * lighting::kFeatureCells});
  }

  // The last layer begins with the light that is usual, whatever the face.
  void start_at_median() {
    const torch::NoGradGuard no_grad;
    const std::string last = "layers." + std::to_string(config_.hidden.size());
    constexpr double kSmall = 0.1;
    net_->named_parameters()[last + ".weight"].mul_(kSmall);
    const torch::Tensor median = std::get<0>(data_.light.log().median(0));
    net_->named_parameters()[last + ".bias"].copy_(median.reshape({-1}));
  }

  Examples batch(const std::vector<int>& order, std::int64_t step) const {
    const std::int64_t first = step * config_.batch;
    const std::int64_t count = std::min<std::int64_t>(config_.batch, data_.count() - first);
    torch::Tensor index = torch::empty({count}, torch::kLong);
    for (std::int64_t i = 0; i < count; ++i)
      index.data_ptr<std::int64_t>()[i] = order[static_cast<std::size_t>(first + i)];
    Examples out{data_.features.index_select(0, index), data_.light.index_select(0, index)};
    const torch::Tensor turned = torch::rand({count}) < 0.5;
    const Examples mirrored{out.features.index_select(1, mirror_features_), out.light.index_select(1, mirror_)};
    out = chosen(turned, mirrored, out);
    return chosen(torch::rand({count}) < config_.grey_share, grey(out), out);
  }

  static Examples chosen(const torch::Tensor& which, const Examples& yes, const Examples& no) {
    return {torch::where(which.view({-1, 1}), yes.features, no.features),
            torch::where(which.view({-1, 1, 1}), yes.light, no.light)};
  }

  LightLoss::Terms one_step(const Examples& examples, std::int64_t step) {
    net_->train();
    optimizer_.zero_grad();
    // Noise in the units of each input's spread.
    const torch::Tensor spread = 1 / net_->named_buffers()["scale"];
    torch::Tensor features = examples.features + config_.input_noise * spread * torch::randn_like(examples.features);
    const torch::Tensor kept = torch::rand_like(features) >= config_.input_drop;
    features = torch::where(kept, features, net_->named_buffers()["mean"].expand_as(features));
    const LightLoss::Terms terms = loss_.terms(light_of(features), examples.light);
    (terms.diffuse + config_.shape_weight * terms.shape + config_.lobe_weight * terms.glossy).backward();
    constexpr double kLargestGradient = 1;
    torch::nn::utils::clip_grad_norm_(net_->parameters(), kLargestGradient);
    optimizer_.step();
    average_->add(*net_, step);
    return terms;
  }

  torch::Tensor light_of(const torch::Tensor& features) {
    return net_->forward(features, config_.drop).exp().view({-1, lighting::kFeatureCells, 3});
  }

  LightErrors measure(const Examples& examples) {
    const torch::NoGradGuard no_grad;
    net_->eval();
    LightErrors sum;
    for (std::int64_t first = 0; first < examples.count(); first += kExamplesAtOnce) {
      const std::int64_t count = std::min(kExamplesAtOnce, examples.count() - first);
      const LightLoss::Terms terms =
          loss_.terms(light_of(examples.features.narrow(0, first, count)), examples.light.narrow(0, first, count));
      const double share = static_cast<double>(count) / static_cast<double>(examples.count());
      sum.diffuse += share * terms.diffuse.item<double>();
      sum.shape += share * terms.shape.item<double>();
      sum.glossy += share * terms.glossy.item<double>();
    }
    return sum;
  }

  LightConfig config_;
  Examples data_, validation_;
  torch::Tensor mirror_, mirror_features_;
  net::LightMlp net_;
  LightLoss loss_;
  torch::optim::AdamW optimizer_{
      net_->parameters(),
      torch::optim::AdamWOptions(config_.learning_rate).betas({0.9, 0.99}).weight_decay(config_.weight_decay)};
  std::optional<WeightAverage> average_;
};

std::string csv(const std::vector<LightRow>& rows) {
  std::ostringstream text;
  text << "epoch,diffuse,shape,glossy,validation_diffuse,validation_shape,validation_glossy\n";
  for (const LightRow& row : rows) {
    text << row.epoch << ',' << row.training.diffuse << ',' << row.training.shape << ',' << row.training.glossy << ','
         << row.validation.diffuse << ',' << row.validation.shape << ',' << row.validation.glossy << '\n';
  }
  return text.str();
}

}  // namespace

LightReport train_light(const LightRun& run, const std::function<void(const LightRow&, int)>& progress) {
  if (const std::string problem = run.config.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  LightTraining training(run);
  io::create_folder(run.folder);
  io::write_file_atomically(run.folder / "config.json", to_json(run.config));
  LightReport report;
  for (int epoch = 0; epoch < run.config.epochs; ++epoch) {
    report.rows.push_back(training.epoch(epoch));
    if (progress) progress(report.rows.back(), run.config.epochs);
  }
  report.weights = run.folder / "weights.safetensors";
  training.save(report.weights);
  io::write_file_atomically(run.folder / "log.csv", csv(report.rows));
  return report;
}

}  // namespace faceprobe::train
