#pragma once
// A mean over the rows of a picture that does not depend on the number of threads: one partial sum a row, added in order.

#include "faceprobe/core/parallel.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace faceprobe::eval {

struct Partial {
  double sum = 0;
  double count = 0;
};

// row_sum(y) -> Partial for y in [0, rows).
template <class RowSum>
Partial sum_rows(int rows, int threads, const RowSum& row_sum) {
  std::vector<Partial> partial(static_cast<std::size_t>(rows > 0 ? rows : 0));
  parallel_for(rows, threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) partial[static_cast<std::size_t>(y)] = row_sum(y);
  });
  Partial total;
  for (const Partial& row : partial) {
    total.sum += row.sum;
    total.count += row.count;
  }
  return total;
}

inline double mean(const Partial& total) {
  return total.count > 0 ? total.sum / total.count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace faceprobe::eval
