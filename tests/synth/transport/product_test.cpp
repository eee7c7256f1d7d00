#include "faceprobe/core/random.h"
#include "faceprobe/synth/matrix_product.h"
#include "synth/transport/wide_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace faceprobe::synth {
namespace {

// Rows that hold something in a window that follows their feature.
PackedRows windows(int rows, int columns, int threads, RowMatrix& plain) {
  Random random({8});
  Eigen::MatrixXf features(rows, 1);
  plain.setZero(rows, columns);
  for (int r = 0; r < rows; ++r) {
    features(r, 0) = static_cast<float>(random.uniform());
    const int first = static_cast<int>(features(r, 0) * static_cast<float>(columns) * 0.7F);
    for (int c = first; c < first + columns / 4; ++c) plain(r, c) = static_cast<float>(random.uniform());
  }
  return pack_rows(rows, columns, alike_rows(features, 16), threads,
                   [&](int row, float* out) { std::copy_n(plain.row(row).data(), columns, out); });
}

TEST(PackedRows, KeepEveryNumberAndFewZeros) {
  RowMatrix plain;
  const PackedRows packed = windows(137, 400, 2, plain);
  EXPECT_EQ(packed.dense(), plain);
  EXPECT_LT(packed.stored(), 137U * 400U / 2U);
  EXPECT_LE((packed.row_sums() - plain.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-4F);
  std::set<int> rows;
  for (const PackedRows::Block& block : packed.blocks()) {
    EXPECT_LE(block.row.size(), 16U);
    rows.insert(block.row.begin(), block.row.end());
  }
  EXPECT_EQ(rows.size(), 137U);
}

TEST(PackedRows, DropWhatIsNegligibleInItsRow) {
  const PackedRows packed = pack_rows(
      2, 3, {{0, 1}}, 1,
      [](int row, float* out) {
        out[0] = row == 0 ? 1.0F : 1000.0F;
        out[1] = 1e-4F;  // a tenth of the limit in row 1, ten times it in row 0
        out[2] = 1e-9F;
      },
      1e-5F);
  EXPECT_EQ(packed.blocks()[0].column, (std::vector<int>{0, 1}));
}

// A denormal factor makes a product many times slower.
TEST(PackedRows, HoldZeroWhereAValueIsNothingToItsRow) {
  const PackedRows packed = pack_rows(
      2, 2, {{0, 1}}, 1,
      [](int row, float* out) {
        out[0] = 1.0F;
        out[1] = row == 0 ? 1e-39F : 0.5F;
      },
      1e-5F);
  EXPECT_EQ(packed.dense(), (RowMatrix(2, 2) << 1.0F, 0.0F, 1.0F, 0.5F).finished());
}

TEST(MatrixProduct, AgreesWithDoublesForAnyNumberOfColumns) {
  RowMatrix plain;
  const PackedRows packed = windows(150, 300, 1, plain);
  Random random({9});
  for (const int columns : {1, 3, 31, 32, 33, 96, 100}) {
    RowMatrix light(300, columns);
    for (Eigen::Index i = 0; i < light.size(); ++i) light.data()[i] = static_cast<float>(random.between(-1, 1));
    const Eigen::MatrixXd expected = plain.cast<double>() * light.cast<double>();
    ProductScratch scratch;
    for (const PackedRows::Block& block : packed.blocks()) {
      const Eigen::MatrixXd rows = expected(block.row, Eigen::all);
      for (const ProductKernel kernel : {ProductKernel::kBest, ProductKernel::kLibrary}) {
        Eigen::MatrixXf out;
        multiply_block(block, light, out, scratch, kernel);
        ASSERT_EQ(out.cols(), columns);
        EXPECT_LE((out.cast<double>() - rows).cwiseAbs().maxCoeff(), 1e-5);  // 75 terms below 1, rounded to 6e-8 each
      }
    }
  }
}

TEST(MatrixProduct, EmptyBlockGivesZeros) {
  const PackedRows packed = pack_rows(5, 10, {{0, 1, 2, 3, 4}}, 1, [](int, float*) {});
  ProductScratch scratch;
  Eigen::MatrixXf out = Eigen::MatrixXf::Ones(1, 1);
  multiply_block(packed.blocks()[0], RowMatrix::Ones(10, 6), out, scratch);
  EXPECT_EQ(out, Eigen::MatrixXf::Zero(5, 6));
}

TEST(MatrixProduct, SaysWhatItUses) { EXPECT_EQ(product_kernel() == "own AVX-512", has_wide_kernel()); }

}  // namespace
}  // namespace faceprobe::synth
