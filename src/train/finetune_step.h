#pragma once
// Internal: what one step of finetuning learns from: some photos of one person, and synthetic faces.
//
//   FinetuneStep source(run.config, model, before, people.trained, faces, faces_config, 0);
//   const StepLoss loss = source.add_gradients(step);

#include "train/finetune_model.h"
#include "train/finetune_people.h"

#include <optional>
#include <vector>

namespace faceprobe::train {

struct StepLoss {
  double whole = 0;  // what the step lowers
  bool people =
      false;  // whether the photos that were drawn have enough in common; synthetic faces are learnt from all the same
  FinetuneRow parts{};
};

class FinetuneStep {
 public:
  // `model`: what is trained. `before`: the same as it was, whose layers are trusted; evaluating. `faces`: nullptr = no synthetic faces;
  // `faces_config`: how they are drawn and what their loss is. All of them outlive this.
  FinetuneStep(const FinetuneConfig& config, const Model& model, const Model& before,
               const std::vector<const PersonSet*>& people, const synth::ShardReader* faces,
               const TrainConfig& faces_config, std::int64_t first_step);

  // To the model's gradients; depends on the seed and the step. Steps follow one another from the first.
  StepLoss add_gradients(std::int64_t step);

 private:
  void add_people(std::int64_t step, StepLoss& loss);

  const FinetuneConfig& config_;
  const Model& model_;
  const Model& before_;
  const std::vector<const PersonSet*>& people_;
  PersonLossOptions options_;
  const TrainConfig& faces_config_;
  std::optional<BatchSource> source_;
};

}  // namespace faceprobe::train
