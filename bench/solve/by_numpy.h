#pragma once
// The same products by NumPy, in a process of its own.

#include "solve/products.h"

#include <optional>
#include <string>
#include <vector>

namespace faceprobe::bench {

struct NumpyRuns {
  std::string version, libraries;  // NumPy's; the BLAS that it had loaded
  struct Kind {
    std::string name;  // "float32", "float64"
    std::vector<double> seconds;
    Products::Result result;  // of the last run
  };
  std::vector<Kind> kinds;
};

// `python`: the program. Nothing when that has no NumPy, or there is no such program. Throws Error(kUnexpected) when the script fails otherwise.
std::optional<NumpyRuns> by_numpy(const Products& products, const std::string& python, int threads, int runs);

}  // namespace faceprobe::bench
