#include "train/finetune_step.h"

namespace faceprobe::train {

FinetuneStep::FinetuneStep(const FinetuneConfig& config, const Model& model, const Model& before,
                           const std::vector<const PersonSet*>& people, const synth::ShardReader* faces,
                           const TrainConfig& faces_config, std::int64_t first_step)
    : config_(config), model_(model), before_(before), people_(people), options_(person_loss_options(config)),
      faces_config_(faces_config) {
  if (faces != nullptr) source_.emplace(*faces, faces_config, first_step);
}

StepLoss FinetuneStep::add_gradients(std::int64_t step) {
  StepLoss loss;
  add_people(step, loss);
  if (source_) {
    const torch::Tensor synthetic = model_.loss(source_->next(), faces_config_.loss);
    synthetic.backward();
    loss.parts.synthetic_loss = synthetic.item<double>();
    loss.whole += loss.parts.synthetic_loss;
  }
  return loss;
}

void FinetuneStep::add_people(std::int64_t step, StepLoss& loss) {
  Random random({config_.seed, 0xF17E, static_cast<std::uint64_t>(step)});
  const PersonSet& person = *people_[static_cast<std::size_t>(random.below(static_cast<int>(people_.size())))];
  const std::vector<int> chosen = drawn_photos(person, config_.photos, random.split(1));
  const std::optional<PersonPhotos> group = group_of(person, chosen, options_);
  if (!group) return;
  std::vector<Shown> shown;
  std::vector<Image> layers;
  for (const int number : chosen) {
    const auto i = static_cast<std::size_t>(number);
    shown.push_back(show(model_, person, i));
    layers.push_back(layer_of(shown.back(), person.photos[i]->linear));
  }
  // What the network made of these photos before it was finetuned is what layers are held to.
  const LayerMeasures trusted = group->loss(layers_of(before_, person, chosen)).measures;
  const PersonLoss found = group->loss(layers, trusted);
  for (std::size_t k = 0; k < shown.size(); ++k)
    shown[k].highlight.backward(config_.weight * padded_gradient(found.by_highlight[k], shown[k].highlight));
  loss.people = true;
  loss.parts.residual = found.residual;
  loss.parts.energy = found.energy;
  loss.parts.guards = found.guards;
  loss.whole += config_.weight * (found.residual + found.guards + found.kept);
}

}  // namespace faceprobe::train
