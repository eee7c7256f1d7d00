#pragma once
// A matrix product by AVX-512.

#include <cstddef>

namespace faceprobe::synth {

inline constexpr std::size_t kWideColumns = 32;  // of a panel

bool has_wide_kernel();

// out (column-major, `rows` high) gets `columns` <= kWideColumns columns: the first `rows` rows of `a` (row-major, `inner` wide) times
// `panel` (inner x kWideColumns, row-major, aligned to 64 bytes). Only where has_wide_kernel().
void multiply_panel(const float* a, const float* panel, std::size_t rows, std::size_t inner, std::size_t columns,
                    float* out);

}  // namespace faceprobe::synth
