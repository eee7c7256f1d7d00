// As one would write it down: no blocks, no vector types, no threads. Compiled with -O3 as the library is (bench/CMakeLists.txt); both loops go
// along the rows, as memory lies.

#include "solve/products.h"
#include "solve/stopwatch.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace faceprobe::bench {
namespace {

using Numbers = std::vector<double>;

struct Dense {
  Numbers values;
  std::size_t rows = 0, cells = 0;
};

// T e.
void forward(const Dense& t, std::size_t rows, const Numbers& light, Numbers& predicted) {
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < t.cells; ++j) sum += t.values[i * t.cells + j] * light[j];
    predicted[i] = sum;
  }
}

// T' r.
void back(const Dense& t, std::size_t rows, const Numbers& ratio, Numbers& correction) {
  std::fill(correction.begin(), correction.end(), 0.0);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < t.cells; ++j) correction[j] += t.values[i * t.cells + j] * ratio[i];
  }
}

}  // namespace

Products::Result by_double_loop(const Products& products) {
  Dense t;
  t.rows = static_cast<std::size_t>(products.transport.rows());
  t.cells = static_cast<std::size_t>(products.transport.cols());
  t.values.assign(products.transport.data(), products.transport.data() + products.transport.size());
  Products::Result result;
  const Stopwatch watch;
  for (const Products::Stage& stage : products.stages()) {
    const auto rows = static_cast<std::size_t>(stage.rows);
    const Eigen::MatrixXf observed = products.observed(stage);
    Eigen::MatrixXd light(products.transport.cols(), stage.channels);
    Numbers sensitivity(t.cells);
    Numbers correction(t.cells);
    Numbers ratio(rows, 1.0);
    back(t, rows, ratio, sensitivity);
    for (int channel = 0; channel < stage.channels; ++channel) {
      Numbers estimate(t.cells, 1.0);
      for (int iteration = 0; iteration < stage.iterations; ++iteration) {
        forward(t, rows, estimate, ratio);
        for (std::size_t i = 0; i < rows; ++i)
          ratio[i] = static_cast<double>(observed(static_cast<Eigen::Index>(i), channel)) / std::max(ratio[i], 1e-30);
        back(t, rows, ratio, correction);
        for (std::size_t j = 0; j < t.cells; ++j) {
          if (sensitivity[j] > 0) estimate[j] *= correction[j] / sensitivity[j];
        }
      }
      for (std::size_t j = 0; j < t.cells; ++j) light(static_cast<Eigen::Index>(j), channel) = estimate[j];
    }
    result.light.push_back(std::move(light));
  }
  result.seconds = watch.seconds();
  return result;
}

}  // namespace faceprobe::bench
