#include "faceprobe/synth/packed_rows.h"

#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <numeric>

namespace faceprobe::synth {
namespace {

// Halves the list where its features spread most, at a multiple of `size`, until the pieces are small enough.
void split(const Eigen::MatrixXf& features, std::vector<int> rows, int size, std::vector<std::vector<int>>& groups) {
  const auto count = static_cast<int>(rows.size());
  if (count <= size) {
    groups.push_back(std::move(rows));
    return;
  }
  int widest = 0;
  float spread = -1;
  for (int d = 0; d < features.cols(); ++d) {
    float mean = 0;
    for (const int row : rows) mean += features(row, d);
    mean /= static_cast<float>(count);
    float variance = 0;
    for (const int row : rows) variance += (features(row, d) - mean) * (features(row, d) - mean);
    if (variance > spread) {
      spread = variance;
      widest = d;
    }
  }
  const int middle = (count / 2 + size - 1) / size * size;
  // Equal features are told apart by their number, so that the order is one.
  std::nth_element(rows.begin(), rows.begin() + middle, rows.end(), [&](int a, int b) {
    return features(a, widest) != features(b, widest) ? features(a, widest) < features(b, widest) : a < b;
  });
  std::vector<int> upper(rows.begin() + middle, rows.end());
  rows.resize(static_cast<std::size_t>(middle));
  split(features, std::move(rows), size, groups);
  if (!upper.empty()) split(features, std::move(upper), size, groups);
}

PackedRows::Block pack_block(const std::vector<int>& rows, int columns, const std::function<void(int, float*)>& fill,
                             float negligible, RowMatrix& scratch) {
  // Of a row's peak; what is below adds nothing to a sum of floats, but as a denormal number it makes a product many times slower.
  constexpr float kNothing = 1e-12F;
  const auto count = static_cast<Eigen::Index>(rows.size());
  scratch.setZero(count, columns);
  Eigen::ArrayXf largest = Eigen::ArrayXf::Zero(columns);  // per column: value in shares of its row's largest
  for (Eigen::Index i = 0; i < count; ++i) {
    fill(rows[static_cast<std::size_t>(i)], scratch.row(i).data());
    const float peak = scratch.row(i).cwiseAbs().maxCoeff();
    scratch.row(i) = (scratch.row(i).array().abs() < kNothing * peak).select(0.0F, scratch.row(i));
    if (peak > 0) largest = largest.max(scratch.row(i).transpose().array().abs() / peak);
  }
  PackedRows::Block block;
  block.row = rows;
  for (int c = 0; c < columns; ++c) {
    if (largest(c) > negligible) block.column.push_back(c);
  }
  block.values.resize(count, static_cast<Eigen::Index>(block.column.size()));
  for (Eigen::Index i = 0; i < count; ++i) {
    const float* from = scratch.row(i).data();
    float* to = block.values.row(i).data();
    for (std::size_t k = 0; k < block.column.size(); ++k) to[k] = from[block.column[k]];
  }
  return block;
}

}  // namespace

PackedRows::PackedRows(int rows, int columns, std::vector<Block> blocks)
    : rows_(rows), columns_(columns), blocks_(std::move(blocks)) {}

std::size_t PackedRows::stored() const {
  std::size_t sum = 0;
  for (const Block& block : blocks_) sum += block.row.size() * block.column.size();
  return sum;
}

RowMatrix PackedRows::dense() const {
  RowMatrix out = RowMatrix::Zero(rows_, columns_);
  for (const Block& block : blocks_) out(block.row, block.column) = block.values;
  return out;
}

Eigen::VectorXf PackedRows::row_sums() const {
  Eigen::VectorXf out = Eigen::VectorXf::Zero(rows_);
  for (const Block& block : blocks_) out(block.row) = block.values.rowwise().sum();
  return out;
}

std::vector<std::vector<int>> alike_rows(const Eigen::MatrixXf& features, int size) {
  std::vector<std::vector<int>> groups;
  std::vector<int> rows(static_cast<std::size_t>(features.rows()));
  std::iota(rows.begin(), rows.end(), 0);
  if (!rows.empty()) split(features, std::move(rows), size, groups);
  for (std::vector<int>& group : groups) std::sort(group.begin(), group.end());
  return groups;
}

PackedRows pack_rows(int rows, int columns, const std::vector<std::vector<int>>& groups, int threads,
                     const std::function<void(int row, float* out)>& fill, float negligible) {
  std::vector<PackedRows::Block> blocks(groups.size());
  parallel_for(static_cast<int>(groups.size()), threads, [&](int first, int last) {
    RowMatrix scratch;
    for (int g = first; g < last; ++g) {
      const auto i = static_cast<std::size_t>(g);
      blocks[i] = pack_block(groups[i], columns, fill, negligible, scratch);
    }
  });
  return {rows, columns, std::move(blocks)};
}

}  // namespace faceprobe::synth
