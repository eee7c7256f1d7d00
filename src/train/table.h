#pragma once
// Internal: rows of numbers as a tensor of doubles, which is how checkpoints keep logs.
//
//   std::vector<std::array<double, 2>> rows;                  // step and loss
//   const torch::Tensor table = table_of(rows);               // rows x 2
//   for (const auto& [step, loss] : rows_of<2>(table)) ...

#include <torch/torch.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace faceprobe::train {

template <std::size_t N>
torch::Tensor table_of(const std::vector<std::array<double, N>>& rows) {
  torch::Tensor table =
      torch::zeros({static_cast<std::int64_t>(rows.size()), static_cast<std::int64_t>(N)}, torch::kDouble);
  double* to = table.data_ptr<double>();
  for (const std::array<double, N>& row : rows) to = std::copy(row.begin(), row.end(), to);
  return table;
}

// `table`: of N columns.
template <std::size_t N>
std::vector<std::array<double, N>> rows_of(const torch::Tensor& table) {
  const torch::Tensor plain = table.to(torch::kDouble).contiguous();
  std::vector<std::array<double, N>> rows(static_cast<std::size_t>(plain.size(0)));
  const double* from = plain.data_ptr<double>();
  for (std::array<double, N>& row : rows) {
    std::copy_n(from, N, row.begin());
    from += N;
  }
  return rows;
}

}  // namespace faceprobe::train
