#include "faceprobe/train/finetune.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/permutation.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"

#include "net/padded_picture.h"
#include "net/torch/mscr.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/unet.h"
#include "net/torch/weights.h"
#include "train/batch.h"
#include "train/model.h"
#include "train/person_loss.h"
#include "train/schedule.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kFinetuneRowEvery = 10;  // steps
constexpr int kScoreRounds = 3;                 // groups of photos of a person who is measured
constexpr Eigen::Index kLeastSkin = 200;        // pixels of the square that a group of photos must share

// As the weights were trained, so that what they know is kept by the loss they learnt it by.
TrainConfig config_of(const std::filesystem::path& weights) {
  const net::ModelInfo info = net::read_model_info(weights);
  if (info.architecture != net::kUNetArchitecture && info.architecture != net::kFaceArchitecture &&
      info.architecture != net::kMscrArchitecture) {
    throw Error(ExitCode::kInput, weights.string() + " holds the network \"" + info.architecture +
                                      "\"; what is finetuned is unet, face and mscr.");
  }
  TrainConfig config;
  if (const auto run = info.metadata.find("run"); run != info.metadata.end()) {
    const nlohmann::json json = nlohmann::json::parse(run->second, nullptr, false);
    if (json.is_object() && json.contains("config")) config = train_config_from_json(json["config"].dump());
  }
  config.architecture = info.architecture;
  config.network = info.options_json;
  config.precision = "float32";  // on the processor, whatever they were trained on
  return config;
}

Model model_of(const std::filesystem::path& weights) {
  Model model = make_model(config_of(weights));
  net::load_weights(*model.module, weights);
  return model;
}

// As large as `like`; what is beyond the picture is off the mesh.
Image padded_mesh(const Image& mesh, const Image& like) {
  Image padded(like.width(), like.height(), 3);
  for (int y = 0; y < mesh.height(); ++y) std::copy_n(mesh.pixel(0, y), mesh.row(y).size(), padded.pixel(0, y));
  return padded;
}

struct PaddedPhoto {
  net::PaddedPicture picture;
  Image mesh;
};

// One photo as a batch of its own, padded to a multiple; `padded` owns the values.
Batch batch_of(PaddedPhoto& padded) {
  Batch batch{net::tensor_view(padded.picture.linear),
              net::tensor_view(padded.picture.clip),
              net::tensor_view(padded.picture.mask),
              {},
              {}};
  batch.surface.mesh = net::tensor_view(padded.mesh);
  return batch;
}

int multiple_of(const Model& model) {
  const auto unet = std::dynamic_pointer_cast<net::UNetImpl>(model.module);
  return unet ? unet->multiple() : net::kMscrMultiple;
}

struct Shown {
  PaddedPhoto padded;
  torch::Tensor highlight;  // with its graph
};

Shown show(const Model& model, const PersonSet& person, std::size_t i, int multiple) {
  const PersonPhoto& photo = *person.photos[i];
  Shown shown{{net::pad_picture(photo.linear, photo.clipped, person.masks[i], multiple), {}}, {}};
  shown.padded.mesh = padded_mesh(person.meshes[i], shown.padded.picture.linear);
  shown.highlight = model.forward(batch_of(shown.padded));
  return shown;
}

Image layer_of(const Shown& shown, const PersonPhoto& photo) {
  return net::crop_to_picture(shown.highlight.detach(), photo.linear.width(), photo.linear.height());
}

// A gradient for the padded tensor; nothing acts on the padding.
torch::Tensor padded_gradient(const Image& gradient, const torch::Tensor& like) {
  Image copy = gradient;
  torch::Tensor whole = torch::zeros_like(like);
  whole.narrow(2, 0, gradient.height()).narrow(3, 0, gradient.width()).copy_(net::tensor_view(copy));
  return whole;
}

// `count` different photos of a person.
std::vector<int> drawn(std::size_t available, int count, Random random) {
  std::vector<int> order = permutation(static_cast<int>(available), random);
  order.resize(std::min(available, static_cast<std::size_t>(count)));
  return order;
}

// Nothing when the photos show too little in common.
std::optional<PersonPhotos> group_of(const PersonSet& person, const std::vector<int>& chosen,
                                     const PersonLossOptions& options) {
  std::vector<PersonPhoto> photos;
  for (const int i : chosen) photos.push_back(*person.photos[static_cast<std::size_t>(i)]);
  try {
    PersonPhotos group(std::move(photos), person.regions, options);
    if (group.pixels() >= kLeastSkin) return group;
  } catch (const std::invalid_argument&) {  // no common skin at all
  }
  return std::nullopt;
}

class Finetuning {
 public:
  Finetuning(const FinetuneRun& run, const FinetuneHooks& hooks)
      : run_(run), hooks_(hooks), model_(model_of(run.start)), before_(model_of(run.start)),
        multiple_(multiple_of(model_)),
        optimizer_(model_.module->parameters(),
                   torch::optim::AdamWOptions(run.config.learning_rate).betas({0.9, 0.99}).weight_decay(0)) {
    before_.module->eval();
    split_people();
    loss_.energy_weight = run.config.energy_weight;
    if (run.config.mode == "paper") loss_ = {.rank1 = false, .blur_sigma_px = 0, .guard_weight = 0, .energy_weight = 0};
    if (run.config.synthetic_batch > 0) {
      faces_.emplace(run.synthetic);
      faces_config_ = config_of(run.start);
      require_meshes(*faces_, run.synthetic, faces_config_);
      faces_config_.batch = run.config.synthetic_batch;
      faces_config_.seed = run.config.seed;
      faces_config_.steps = run.config.steps;
      source_.emplace(*faces_, faces_config_, 0);
    }
  }

  FinetuneReport go() {
    io::create_folder(run_.folder);
    FinetuneReport report;
    report.before = score();
    FinetuneRow sum;
    std::int64_t counted = 0;
    std::int64_t told = 0;  // steps that rows tell of
    std::int64_t step = 0;
    for (; step < run_.config.steps; ++step) {
      if (hooks_.stop && hooks_.stop()) break;
      counted += one_step(step, sum) ? 1 : 0;
      if ((step + 1) % kFinetuneRowEvery != 0 && step + 1 != run_.config.steps) continue;
      const double n = static_cast<double>(std::max<std::int64_t>(1, counted));
      const double steps = static_cast<double>(step + 1 - told);
      told = step + 1;
      report.rows.push_back({step + 1, sum.residual / n, sum.energy / n, sum.guards / n, sum.synthetic_loss / steps});
      if (hooks_.progress) hooks_.progress(report.rows.back(), run_.config.steps);
      sum = {};
      counted = 0;
    }
    report.finished = step == run_.config.steps;
    report.after = score();
    report.weights = run_.folder / "weights.safetensors";
    save(report);
    return report;
  }

 private:
  void split_people() {
    for (const PersonSet& person : run_.people) {
      // By name, so that a person of two folders of that name is on one side.
      const std::string name = person.name.substr(person.name.rfind('/') + 1);
      std::uint64_t key = 0;
      for (const char c : name)
        key = key * 131 + static_cast<std::uint64_t>(std::tolower(static_cast<unsigned char>(c)));
      const bool held_out = Random({run_.config.seed, 0x9E0, key}).uniform() < run_.config.held_out_share;
      (held_out ? held_out_ : trained_).push_back(&person);
    }
    if (trained_.empty() || held_out_.empty()) {
      throw Error(ExitCode::kInput, "Of " + std::to_string(run_.people.size()) + " people with enough photos " +
                                        std::to_string(held_out_.size()) + " would be held out and " +
                                        std::to_string(trained_.size()) +
                                        " trained on; give more people, or another held-out share or seed.");
    }
  }

  // False when the photos that were drawn have too little in common; the synthetic faces are learnt from all the same.
  bool one_step(std::int64_t step, FinetuneRow& sum) {
    // Dropout, which the paper's network has, depends on the seed and the step alone.
    torch::manual_seed(run_.config.seed ^ (static_cast<std::uint64_t>(step) << 20U));
    set_rate(step);
    optimizer_.zero_grad();
    const bool used = add_people(step, sum);
    if (source_) {
      const Batch batch = source_->next();
      const torch::Tensor loss = model_.loss(batch, faces_config_.loss);
      loss.backward();
      sum.synthetic_loss += loss.item<double>();
    }
    const double norm = torch::nn::utils::clip_grad_norm_(model_.module->parameters(), run_.config.largest_gradient);
    if (!std::isfinite(norm)) {
      throw Error(ExitCode::kUnexpected,
                  "The loss is no number any more after step " + std::to_string(step) + "; lower the learning rate.");
    }
    optimizer_.step();
    return used;
  }

  // A half cosine down to a hundredth: what a constant rate leaves in the weights is noise, and the synthetic faces show it.
  void set_rate(std::int64_t step) {
    constexpr double kFinalShare = 0.01;
    const double done = static_cast<double>(step) / static_cast<double>(run_.config.steps);
    set_learning_rate(optimizer_, run_.config.learning_rate * half_cosine(done, kFinalShare));
  }

  // What the network made of these photos before it was finetuned.
  LayerMeasures measures_before(const PersonSet& person, const std::vector<int>& chosen,
                                const PersonPhotos& group) const {
    const torch::NoGradGuard no_gradients;
    std::vector<Image> layers;
    for (const int number : chosen) {
      const auto i = static_cast<std::size_t>(number);
      layers.push_back(layer_of(show(before_, person, i, multiple_), *person.photos[i]));
    }
    return group.loss(layers).measures;
  }

  bool add_people(std::int64_t step, FinetuneRow& sum) {
    Random random({run_.config.seed, 0xF17E, static_cast<std::uint64_t>(step)});
    const PersonSet& person = *trained_[static_cast<std::size_t>(random.below(static_cast<int>(trained_.size())))];
    const std::vector<int> chosen = drawn(person.photos.size(), run_.config.photos, random.split(1));
    const std::optional<PersonPhotos> group = group_of(person, chosen, loss_);
    if (!group) return false;
    std::vector<Shown> shown;
    std::vector<Image> layers;
    for (const int number : chosen) {
      const auto i = static_cast<std::size_t>(number);
      shown.push_back(show(model_, person, i, multiple_));
      layers.push_back(layer_of(shown.back(), *person.photos[i]));
    }
    const PersonLoss loss = group->loss(layers, measures_before(person, chosen, *group));
    for (std::size_t k = 0; k < shown.size(); ++k) {
      shown[k].highlight.backward(run_.config.weight * padded_gradient(loss.by_highlight[k], shown[k].highlight));
    }
    sum.residual += loss.residual;
    sum.energy += loss.energy;
    sum.guards += loss.guards;
    return true;
  }

  PeopleScore score() {
    const torch::NoGradGuard no_gradients;
    model_.module->eval();
    PeopleScore out;
    for (const PersonSet* person : held_out_) {
      PeopleScore own;
      for (int round = 0; round < kScoreRounds; ++round) {
        const std::vector<int> chosen = drawn(person->photos.size(), run_.config.photos,
                                              Random({run_.config.seed, 0x5C03, static_cast<std::uint64_t>(round)}));
        const std::optional<PersonPhotos> group = group_of(*person, chosen, loss_);
        if (!group) continue;
        std::vector<Image> layers, none;
        for (const int number : chosen) {
          const auto i = static_cast<std::size_t>(number);
          const PersonPhoto& photo = *person->photos[i];
          layers.push_back(layer_of(show(model_, *person, i, multiple_), photo));
          none.emplace_back(photo.linear.width(), photo.linear.height(), 3);
        }
        const PersonLoss loss = group->loss(layers);
        own.residual += loss.residual;
        own.energy += loss.energy;
        own.untouched += group->loss(none).residual;
        ++own.people;
      }
      if (own.people == 0) continue;
      ++out.people;
      out.residual += own.residual / own.people;
      out.energy += own.energy / own.people;
      out.untouched += own.untouched / own.people;
    }
    if (out.people == 0) {
      throw Error(ExitCode::kInput, "No held-out person has photos that show the same skin; give more people.");
    }
    out.residual /= out.people;
    out.energy /= out.people;
    out.untouched /= out.people;
    model_.module->train();
    return out;
  }

  void save(const FinetuneReport& report) {
    const FinetuneConfig& config = run_.config;
    const nlohmann::ordered_json json = {{"mode", config.mode},
                                         {"steps", report.rows.empty() ? 0 : report.rows.back().step},
                                         {"photos", config.photos},
                                         {"synthetic_batch", config.synthetic_batch},
                                         {"learning_rate", config.learning_rate},
                                         {"weight", config.weight},
                                         {"energy_weight", config.energy_weight},
                                         {"seed", config.seed},
                                         {"people", trained_.size()},
                                         {"start", net::read_model_info(run_.start).sha256}};
    std::map<std::string, std::string> metadata = model_.metadata;
    metadata["finetune"] = json.dump(1);
    net::save_weights(*model_.module, report.weights, metadata, true);
    std::ostringstream csv;
    csv << "step,residual,energy,guards,synthetic_loss\n";
    for (const FinetuneRow& row : report.rows) {
      csv << row.step << ',' << row.residual << ',' << row.energy << ',' << row.guards << ',' << row.synthetic_loss
          << '\n';
    }
    io::write_file_atomically(run_.folder / "log.csv", csv.str());
  }

  const FinetuneRun& run_;
  const FinetuneHooks& hooks_;
  Model model_;
  Model before_;
  int multiple_;
  torch::optim::AdamW optimizer_;
  PersonLossOptions loss_;
  std::vector<const PersonSet*> trained_, held_out_;
  std::optional<synth::ShardReader> faces_;
  TrainConfig faces_config_;
  std::optional<BatchSource> source_;  // last: it reads faces_
};

std::string out_of_range(const char* name, double value, const char* allowed) {
  std::ostringstream text;
  text << name << " is " << value << "; allowed is " << allowed << '.';
  return text.str();
}

}  // namespace

std::string FinetuneConfig::validate() const {
  if (mode != "default" && mode != "paper") return "mode is \"" + mode + "\"; there are default and paper.";
  if (steps < 1 || steps > 1'000'000) return out_of_range("steps", static_cast<double>(steps), "1 to 1e6");
  if (photos < 2 || photos > 64) return out_of_range("photos", photos, "2 to 64");
  if (synthetic_batch < 0 || synthetic_batch > 4096)
    return out_of_range("synthetic_batch", synthetic_batch, "0 to 4096");
  if (!(learning_rate > 0 && learning_rate <= 1)) return out_of_range("learning_rate", learning_rate, "above 0, to 1");
  if (!(weight >= 0 && weight <= 1000)) return out_of_range("weight", weight, "0 to 1000");
  if (!(energy_weight >= 0 && energy_weight <= 100)) return out_of_range("energy_weight", energy_weight, "0 to 100");
  if (!(largest_gradient > 0 && largest_gradient <= 1e6))
    return out_of_range("largest_gradient", largest_gradient, "above 0, to 1e6");
  if (!(held_out_share > 0 && held_out_share < 1))
    return out_of_range("held_out_share", held_out_share, "between 0 and 1");
  return {};
}

FinetuneReport finetune_highlight(const FinetuneRun& run, const FinetuneHooks& hooks) {
  if (const std::string fault = run.config.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  return Finetuning(run, hooks).go();
}

}  // namespace faceprobe::train
