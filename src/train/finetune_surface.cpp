#include "faceprobe/train/finetune_surface.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/random.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/net/model_file.h"
#include "net/torch/weights.h"
#include "train/batch.h"
#include "train/face_loss.h"
#include "train/finetune_people.h"
#include "train/model.h"
#include "train/schedule.h"
#include "train/surface_photo.h"
#include "train/validate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <sstream>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kSurfaceRowEvery = 10;  // steps

class SurfaceFinetuning {
 public:
  SurfaceFinetuning(const FinetuneSurfaceRun& run, const FinetuneSurfaceHooks& hooks)
      : run_(run), hooks_(hooks), config_(face_config_of(run.start)), model_(face_model(config_, run.start)),
        people_(split_people(run.people, run.config.seed, run.config.held_out_share)),
        looker_(model_, config_, run.start),
        optimizer_(model_.module->parameters(),
                   torch::optim::AdamWOptions(run.config.learning_rate).betas({0.9, 0.99}).weight_decay(0)) {
    if (!run.validation.empty()) {
      const synth::ShardReader faces(run.validation);
      require_meshes(faces, run.validation, config_);
      validator_.emplace(faces, config_, torch::Device(torch::kCPU));
    }
    if (run.config.synthetic_batch == 0) return;
    faces_.emplace(run.synthetic);
    require_meshes(*faces_, run.synthetic, config_);
    TrainConfig synthetic = config_;
    synthetic.batch = run.config.synthetic_batch;
    synthetic.seed = run.config.seed;
    synthetic.steps = run.config.steps;
    source_.emplace(*faces_, synthetic, 0);
  }

  FinetuneSurfaceReport go() {
    FinetuneSurfaceReport report;
    report.before = score();
    report.validated = validator_.has_value();
    if (validator_) report.dev_before = validator_->measure(model_);
    io::create_folder(run_.folder);
    std::int64_t step = 0;
    for (; step < run_.config.steps; ++step) {
      if (hooks_.stop && hooks_.stop()) break;
      one_step(step);
      if ((step + 1) % kSurfaceRowEvery != 0 && step + 1 != run_.config.steps) continue;
      report.rows.push_back(row_at(step + 1));
      if (hooks_.progress) hooks_.progress(report.rows.back(), run_.config.steps);
    }
    report.finished = step == run_.config.steps;
    report.after = score();
    if (validator_) report.dev_after = validator_->measure(model_);
    report.weights = run_.folder / "weights.safetensors";
    save(report, step);
    return report;
  }

 private:
  // Sums over the steps since the last row, and over how many.
  struct Sums {
    double residual = 0, albedo = 0, lights = 0, guards = 0, synthetic_loss = 0;
    int people = 0, compared = 0, lit = 0, guarded = 0;
    std::int64_t steps = 0;
  };

  torch::Tensor guards_of(const std::vector<SurfacePhoto>& photos) {
    torch::Tensor sum = torch::zeros({}, torch::kDouble);
    for (const SurfacePhoto& photo : photos)
      sum = sum + surface_guards(photo.found, photo.start, photo.skin, run_.config.rerender).sum();
    const torch::Tensor mean = sum / static_cast<double>(photos.size());
    sums_.guards += mean.item<double>();
    ++sums_.guarded;
    return run_.config.rerender.guard_weight * mean;
  }

  void learn_person(Random random) {
    const PersonSet& person =
        *people_.trained[static_cast<std::size_t>(random.below(static_cast<int>(people_.trained.size())))];
    const std::vector<SurfacePhoto> photos =
        looker_.look(person, drawn_photos(person, run_.config.photos, random.split(1)));
    if (photos.empty()) return;
    torch::Tensor residual = torch::zeros({}, torch::kDouble);
    for (const SurfacePhoto& photo : photos) residual = residual + residual_of(photo, Trust::kStated);
    residual = residual / static_cast<double>(photos.size());
    torch::Tensor loss = residual + guards_of(photos);
    if (const std::optional<torch::Tensor> apart = albedos_apart(photos)) {
      loss = loss + run_.config.rerender.albedo_weight * *apart;
      sums_.albedo += apart->item<double>();
      ++sums_.compared;
    }
    (run_.config.weight * loss).backward();
    sums_.residual += residual.item<double>();
    ++sums_.people;
  }

  // Photos of different people, whose shadings one light must explain.
  void learn_light(Random random) {
    const PersonSet& set = run_.lights[static_cast<std::size_t>(random.below(static_cast<int>(run_.lights.size())))];
    const std::vector<SurfacePhoto> photos = looker_.look(set, drawn_photos(set, run_.config.photos, random.split(1)));
    if (photos.empty()) return;
    std::vector<PhotoSurface> surfaces;
    std::vector<torch::Tensor> skin;
    for (const SurfacePhoto& photo : photos) {
      surfaces.push_back(photo.found);
      skin.push_back(photo.skin);
    }
    const torch::Tensor residual = rerender(surfaces, skin, run_.config.rerender).residual;
    (run_.config.weight * (residual + guards_of(photos))).backward();
    sums_.lights += residual.item<double>();
    ++sums_.lit;
  }

  torch::Tensor residual_of(const SurfacePhoto& photo, Trust trust) const {
    return rerender(std::span(&photo.found, 1), std::span(&photo.skin, 1), run_.config.rerender, trust).residual;
  }

  void one_step(std::int64_t step) {
    // A half cosine down to a hundredth: what a constant rate leaves in the weights is noise, and the synthetic faces show it.
    constexpr double kFinalShare = 0.01;
    const double done = static_cast<double>(step) / static_cast<double>(run_.config.steps);
    set_learning_rate(optimizer_, run_.config.learning_rate * half_cosine(done, kFinalShare));
    optimizer_.zero_grad();
    const auto number = static_cast<std::uint64_t>(step);
    learn_person(Random({run_.config.seed, 0x5F17E, number}));
    if (!run_.lights.empty()) learn_light(Random({run_.config.seed, 0x116, number}));
    if (source_) {
      const torch::Tensor loss = model_.loss(source_->next(), config_.loss);
      loss.backward();
      sums_.synthetic_loss += loss.item<double>();
    }
    ++sums_.steps;
    const double norm = torch::nn::utils::clip_grad_norm_(model_.module->parameters(), run_.config.largest_gradient);
    if (!std::isfinite(norm)) {
      throw Error(ExitCode::kUnexpected,
                  "The loss is no number any more after step " + std::to_string(step) + "; lower the learning rate.");
    }
    optimizer_.step();
  }

  SurfaceRow row_at(std::int64_t step) {
    const auto mean = [](double sum, auto count) { return count > 0 ? sum / static_cast<double>(count) : 0.0; };
    const SurfaceRow row{step,
                         mean(sums_.residual, sums_.people),
                         mean(sums_.albedo, sums_.compared),
                         mean(sums_.lights, sums_.lit),
                         mean(sums_.guards, sums_.guarded),
                         mean(sums_.synthetic_loss, sums_.steps)};
    sums_ = {};
    return row;
  }

  SurfaceScore score() {
    const torch::NoGradGuard no_gradients;
    model_.module->eval();
    SurfaceScore out;
    int compared = 0;
    for (const PersonSet* person : people_.held_out) {
      // The same photos before and after.
      const std::vector<SurfacePhoto> photos =
          looker_.look(*person, drawn_photos(*person, run_.config.photos, Random({run_.config.seed, 0x5C03})));
      if (photos.empty()) continue;
      const double share = 1.0 / static_cast<double>(photos.size());
      for (const SurfacePhoto& photo : photos) {
        const auto on_skin = [&](const torch::Tensor& values) {
          return ((values * photo.skin).sum() / photo.skin.sum()).item<double>();
        };
        out.residual += share * residual_of(photo, Trust::kEven).item<double>();
        out.contrast += share * shading_contrast(photo.found.shading, photo.skin).item<double>();
        out.confidence += share * on_skin(confidence(photo.found.spread));
        const torch::Tensor half = 0.5 * chord(photo.found.normal, photo.start.normal);
        out.normal_change_deg += share * degrees(1) * on_skin(2 * half.clamp(0, 1).asin());
      }
      if (const std::optional<torch::Tensor> apart = albedos_apart(photos)) {
        out.albedo += apart->item<double>();
        ++compared;
      }
      ++out.people;
    }
    model_.module->train();
    if (out.people == 0)
      throw Error(ExitCode::kInput, "The network sees no skin in any photo of the held-out people; give more people.");
    const double share = 1.0 / out.people;
    out.residual *= share;
    out.contrast *= share;
    out.confidence *= share;
    out.normal_change_deg *= share;
    out.albedo /= std::max(1, compared);
    return out;
  }

  void save(const FinetuneSurfaceReport& report, std::int64_t steps) {
    const FinetuneSurfaceConfig& config = run_.config;
    const RerenderOptions& rerender = config.rerender;
    const nlohmann::ordered_json json = {{"steps", steps},
                                         {"photos", config.photos},
                                         {"synthetic_batch", config.synthetic_batch},
                                         {"learning_rate", config.learning_rate},
                                         {"weight", config.weight},
                                         {"order", rerender.order},
                                         {"ridge", rerender.ridge},
                                         {"albedo_weight", rerender.albedo_weight},
                                         {"guard_weight", rerender.guard_weight},
                                         {"normal_slack_deg", rerender.normal_slack_deg},
                                         {"contrast_slack", rerender.contrast_slack},
                                         {"confidence_slack", rerender.confidence_slack},
                                         {"curl_slack", rerender.curl_slack},
                                         {"largest_gradient", config.largest_gradient},
                                         {"held_out_share", config.held_out_share},
                                         {"seed", config.seed},
                                         {"people", people_.trained.size()},
                                         {"lights", run_.lights.size()},
                                         {"start", net::read_model_info(run_.start).sha256}};
    std::map<std::string, std::string> metadata =
        net::read_model_info(run_.start).metadata;  // of what the weights learnt before
    for (const auto& [key, value] : model_.metadata) metadata[key] = value;
    metadata["finetune_surface"] = json.dump(1);
    net::save_weights(*model_.module, report.weights, metadata, true);
    std::ostringstream csv;
    csv << "step,residual,albedo,lights,guards,synthetic_loss\n";
    for (const SurfaceRow& row : report.rows) {
      csv << row.step << ',' << row.residual << ',' << row.albedo << ',' << row.lights << ',' << row.guards << ','
          << row.synthetic_loss << '\n';
    }
    io::write_file_atomically(run_.folder / "log.csv", csv.str());
  }

  const FinetuneSurfaceRun& run_;
  const FinetuneSurfaceHooks& hooks_;
  TrainConfig config_;
  Model model_;
  SplitPeople people_;
  SurfaceLooker looker_;  // reads model_
  torch::optim::AdamW optimizer_;
  Sums sums_;
  std::optional<Validator> validator_;
  std::optional<synth::ShardReader> faces_;
  std::optional<BatchSource> source_;  // last: it reads faces_
};

}  // namespace

FinetuneSurfaceReport finetune_surface(const FinetuneSurfaceRun& run, const FinetuneSurfaceHooks& hooks) {
  if (const std::string fault = run.config.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  at::set_num_threads(run.threads > 0 ? run.threads : default_thread_count());
  return SurfaceFinetuning(run, hooks).go();
}

}  // namespace faceprobe::train
