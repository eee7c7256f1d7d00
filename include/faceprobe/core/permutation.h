#pragma once
// 0 .. count - 1 in an order drawn by chance, all orders alike (Fisher and Yates); count >= 0.
//
//   for (const int i : permutation(photo_count, Random({seed, step}))) ...

#include "faceprobe/core/random.h"

#include <numeric>
#include <utility>
#include <vector>

namespace faceprobe {

// `random` is a copy: the caller's generator stays where it is.
inline std::vector<int> permutation(int count, Random random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (int i = count - 1; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  return order;
}

}  // namespace faceprobe
