#include "synth/transport/wide_kernel.h"

#include <algorithm>
#include <cassert>

namespace faceprobe::synth {

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

using Vector = float __attribute__((vector_size(64)));

constexpr std::size_t kRows = 12;  // 12 x 2 sums, two vectors of the panel and one number of `a` fill 27 of 32 registers

// Sums of kRows rows, given by their beginnings, and the whole panel.
__attribute__((target("avx512f"))) void multiply_tile(const float* const* a, const float* panel, std::size_t inner,
                                                      float* tile) {
  Vector sum[kRows][2] = {};
  for (std::size_t k = 0; k < inner; ++k) {
    const auto* b = reinterpret_cast<const Vector*>(panel + k * kWideColumns);
    const Vector left = b[0];
    const Vector right = b[1];
#pragma GCC unroll 12
    for (std::size_t r = 0; r < kRows; ++r) {
      const float factor = a[r][k];
      sum[r][0] += factor * left;
      sum[r][1] += factor * right;
    }
  }
  auto* to = reinterpret_cast<Vector*>(tile);
#pragma GCC unroll 12
  for (std::size_t r = 0; r < kRows; ++r) {
    to[2 * r] = sum[r][0];
    to[2 * r + 1] = sum[r][1];
  }
}

}  // namespace

bool has_wide_kernel() { return __builtin_cpu_supports("avx512f") != 0; }

void multiply_panel(const float* a, const float* panel, std::size_t rows, std::size_t inner, std::size_t columns,
                    float* out) {
  alignas(64) float tile[kRows * kWideColumns];
  for (std::size_t first = 0; first < rows; first += kRows) {
    const float* begin[kRows];
    // Past the end the last row is taken again, and thrown away.
    for (std::size_t r = 0; r < kRows; ++r) begin[r] = a + std::min(first + r, rows - 1) * inner;
    multiply_tile(begin, panel, inner, tile);
    const std::size_t count = std::min(kRows, rows - first);
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t r = 0; r < count; ++r) out[c * rows + first + r] = tile[r * kWideColumns + c];
    }
  }
}

#else

bool has_wide_kernel() { return false; }
void multiply_panel(const float*, const float*, std::size_t, std::size_t, std::size_t, float*) { assert(false); }

#endif

}  // namespace faceprobe::synth
