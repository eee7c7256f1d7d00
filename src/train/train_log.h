#pragma once
// Internal: the rows of train.h's log as checkpoints keep them.

#include "faceprobe/train/train.h"

#include <torch/torch.h>
#include <vector>

namespace faceprobe::train {

torch::Tensor table_of_rows(const std::vector<TrainRow>& rows);
std::vector<TrainRow> rows_of_table(const torch::Tensor& table);

}  // namespace faceprobe::train
