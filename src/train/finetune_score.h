#pragma once
// Internal: how good a network is on people and synthetic faces that finetuning does not learn from, and what that looks like.

#include "train/finetune_model.h"
#include "train/finetune_people.h"
#include "train/validate.h"

#include <optional>
#include <vector>

namespace faceprobe::train {

class FinetuneScorer {
 public:
  // `faces`: synthetic ones to measure on; nullptr = none. `config` and `people` outlive this.
  FinetuneScorer(const FinetuneConfig& config, const std::vector<const PersonSet*>& people,
                 const synth::ShardReader* faces, const TrainConfig& faces_config);

  // All but the step. Throws Error(kInput) when no person has photos that show the same skin.
  FinetuneScore measure(const Model& model) const;

  // A row for each of up to eight people, spread evenly over all: photo, highlight before and after, both twice as bright as they are, and
  // the diffuse layer after.
  ByteImage people_picture(const Model& before, const Model& after) const;
  // As Validator's; empty without synthetic faces.
  ByteImage faces_picture(const Model& model) const;

 private:
  std::optional<FinetuneScore> measure_person(const Model& model, const PersonSet& person) const;

  const FinetuneConfig& config_;
  const std::vector<const PersonSet*>& people_;
  PersonLossOptions options_;
  std::optional<Validator> validator_;
};

}  // namespace faceprobe::train
