#pragma once
// Internal: what a finetuning has come to, as checkpoints keep it and as files that are read by people.

#include "faceprobe/train/finetune.h"
#include "train/checkpoint.h"

#include <string>
#include <vector>

namespace faceprobe::train {

struct FinetuneState {
  std::int64_t step = 0;
  std::vector<FinetuneRow> rows;
  std::vector<FinetuneScore> scores;
  FinetuneRow sum;                // over the steps since the last row
  std::int64_t people_steps = 0;  // those of them whose people could be used
};

Checkpoint to_checkpoint(const FinetuneState& state);
FinetuneState from_checkpoint(const Checkpoint& checkpoint);

// The means since the last row become a row.
void add_row(FinetuneState& state);

std::string to_csv(const std::vector<FinetuneRow>& rows);
// With a last column that is 1 at the score whose weights are kept.
std::string to_csv(const std::vector<FinetuneScore>& scores, double max_validation_rise);

// Below one another, 960 x 420 each, logarithmic: of what is trained on, residual (red), mean highlight (black) and loss on synthetic faces
// (blue); the first two of the people that are held out; and, where `validated`, the error on the validation faces (blue).
ByteImage draw_curves(const FinetuneState& state, bool validated);

}  // namespace faceprobe::train
