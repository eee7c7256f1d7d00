#pragma once
// A matrix whose rows are mostly zeros in the same places: rows that are alike (normals that point the same way see the same half of
// the sky) lie together in dense blocks, which keep only the columns that some row of the block uses. A product costs what the
// blocks hold, and runs as fast as a dense one.
//
//   const PackedRows rows = pack_rows(count, cells, alike_rows(normals), threads, [&](int row, float* out) { ... });
//   for (const PackedRows::Block& block : rows.blocks()) ...

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace faceprobe::synth {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class PackedRows {
 public:
  struct Block {
    std::vector<int> row;     // numbers of its rows
    std::vector<int> column;  // and of its columns, rising
    RowMatrix values;         // row.size() x column.size()
  };

  PackedRows() = default;
  // What no block holds is 0.
  PackedRows(int rows, int columns, std::vector<Block> blocks);

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return columns_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  // Numbers that are stored; rows x cols when nothing was saved.
  std::size_t stored() const;
  // The plain matrix; for tests and small uses.
  RowMatrix dense() const;
  Eigen::VectorXf row_sums() const;

 private:
  Eigen::Index rows_ = 0;
  Eigen::Index columns_ = 0;
  std::vector<Block> blocks_;
};

// Groups of at most `size` rows with neighbouring features (#rows x any number of dimensions), in a fixed order.
std::vector<std::vector<int>> alike_rows(const Eigen::MatrixXf& features, int size = 256);

// fill(row, out) writes a row's values into out, which holds `columns` zeros; it is called from several threads. Values below
// `negligible` times their row's largest are left out.
PackedRows pack_rows(int rows, int columns, const std::vector<std::vector<int>>& groups, int threads,
                     const std::function<void(int row, float* out)>& fill, float negligible = 1e-6F);

}  // namespace faceprobe::synth
