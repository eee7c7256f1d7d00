#include "faceprobe/synth/matrix_product.h"

#include "synth/transport/wide_kernel.h"

#ifdef FACEPROBE_HAS_OPENBLAS
#include <cblas.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace faceprobe::synth {
namespace {

// The rows of `light` that a block uses, cut into panels, each as multiply_panel() takes it.
void multiply_wide(const PackedRows::Block& block, const RowMatrix& light, Eigen::MatrixXf& out,
                   std::vector<float>& memory) {
  const std::size_t inner = block.column.size();
  const auto columns = static_cast<std::size_t>(light.cols());
  const std::size_t panels = (columns + kWideColumns - 1) / kWideColumns;
  constexpr std::size_t kAlign = 64;
  memory.resize(panels * inner * kWideColumns + kAlign / sizeof(float));
  auto* begin =
      reinterpret_cast<float*>((reinterpret_cast<std::uintptr_t>(memory.data()) + kAlign - 1) / kAlign * kAlign);
  for (std::size_t k = 0; k < inner; ++k) {
    const float* from = light.row(block.column[k]).data();
    for (std::size_t p = 0; p < panels; ++p) {
      const std::size_t count = std::min(kWideColumns, columns - p * kWideColumns);
      float* to = begin + (p * inner + k) * kWideColumns;
      std::memcpy(to, from + p * kWideColumns, count * sizeof(float));
      std::fill(to + count, to + kWideColumns, 0.0F);
    }
  }
  for (std::size_t p = 0; p < panels; ++p) {
    const std::size_t first = p * kWideColumns;
    multiply_panel(block.values.data(), begin + p * inner * kWideColumns, block.row.size(), inner,
                   std::min(kWideColumns, columns - first), out.col(static_cast<Eigen::Index>(first)).data());
  }
}

void multiply_plain(const PackedRows::Block& block, const RowMatrix& light, Eigen::MatrixXf& out,
                    std::vector<float>& memory) {
  const auto inner = static_cast<Eigen::Index>(block.column.size());
  memory.resize(static_cast<std::size_t>(inner * light.cols()));
  Eigen::Map<RowMatrix> gathered(memory.data(), inner, light.cols());
  for (Eigen::Index k = 0; k < inner; ++k) gathered.row(k) = light.row(block.column[static_cast<std::size_t>(k)]);
#ifdef FACEPROBE_HAS_OPENBLAS
  // The callers are the threads.
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);
  const auto rows = static_cast<int>(block.values.rows());
  const auto columns = static_cast<int>(light.cols());
  cblas_sgemm(CblasColMajor, CblasTrans, CblasTrans, rows, columns, static_cast<int>(inner), 1.0F, block.values.data(),
              static_cast<int>(inner), gathered.data(), columns, 0.0F, out.data(), rows);
#else
  out.noalias() = block.values * gathered;
#endif
}

}  // namespace

void multiply_block(const PackedRows::Block& block, const RowMatrix& light, Eigen::MatrixXf& out,
                    ProductScratch& scratch, ProductKernel kernel) {
  out.resize(block.values.rows(), light.cols());
  if (block.column.empty()) {
    out.setZero();
  } else if (kernel == ProductKernel::kBest && has_wide_kernel()) {
    multiply_wide(block, light, out, scratch.gathered);
  } else {
    multiply_plain(block, light, out, scratch.gathered);
  }
}

std::string product_kernel(ProductKernel kernel) {
  if (kernel == ProductKernel::kBest && has_wide_kernel()) return "own AVX-512";
#ifdef FACEPROBE_HAS_OPENBLAS
  return "OpenBLAS";
#else
  return "Eigen";
#endif
}

}  // namespace faceprobe::synth
