#pragma once
// The matrix product that lights everything: a block of rows times the cells of all maps at once. Each call runs on the thread that
// makes it, and its bytes depend on nothing else.
//
// Which code does it is found out when it runs: an own kernel on processors with AVX-512 (Debian's OpenBLAS knows only those older than
// itself, and is half as fast on the others), else OpenBLAS, or Eigen in a build without it.
//
//   for (const PackedRows::Block& block : rows.blocks()) multiply_block(block, light, out, scratch);

#include "faceprobe/synth/packed_rows.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace faceprobe::synth {

// One thread's working memory.
struct ProductScratch {
  std::vector<float> gathered;
};

// Which code multiplies.
enum class ProductKernel {
  kBest,     // what this processor is fastest with
  kLibrary,  // OpenBLAS or Eigen, on any processor; to compare with
};

// out (block's rows x light's columns) = block x light (all cells x any number of columns).
void multiply_block(const PackedRows::Block& block, const RowMatrix& light, Eigen::MatrixXf& out,
                    ProductScratch& scratch, ProductKernel kernel = ProductKernel::kBest);

// "own AVX-512", "OpenBLAS" or "Eigen".
std::string product_kernel(ProductKernel kernel = ProductKernel::kBest);

}  // namespace faceprobe::synth
