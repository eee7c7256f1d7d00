#include "solve/products.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/lighting/richardson_lucy.h"
#include "solve/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::bench {
namespace {

constexpr float kLeastSeen = 1e-4F;  // noise leaves nothing black, so that no step divides by nothing

}  // namespace

std::vector<Products::Stage> Products::stages() const {
  const lighting::RichardsonLucyOptions usual;
  const auto all = static_cast<int>(transport.rows());
  return {{shading_rows, 10, 1}, {all, usual.iterations, 1}, {all, 6, 3}};
}

Eigen::MatrixXf Products::observed(const Stage& stage) const {
  const Eigen::MatrixX3f rows = seen.topRows(stage.rows);
  if (stage.channels == 1) return rows * kLuminanceWeights;
  return rows;
}

double Products::multiplications() const {
  double sum = 0;
  for (const Stage& stage : stages()) {
    const double once = static_cast<double>(stage.rows) * static_cast<double>(transport.cols());
    sum += once * (1 + 2.0 * stage.iterations * stage.channels);
  }
  return sum;
}

Products make_products(const lighting::Observations& observations, int nside, int threads) {
  const lighting::Transport transport = lighting::build_transport(observations, SphereGrid(nside), threads);
  const Eigen::Index patches = observations.count();
  Products products;
  products.shading_rows = static_cast<int>(patches);
  products.transport.resize(2 * patches, transport.rows.cols());
  products.transport << transport.diffuse(), transport.highlight();
  products.seen.resize(2 * patches, 3);
  products.seen << observations.shading, observations.highlight;
  products.seen = products.seen.cwiseMax(kLeastSeen);
  return products;
}

Products::Result by_library(const Products& products, int threads) {
  Products::Result result;
  lighting::RichardsonLucyOptions options;
  options.unobserved_share = 0;
  options.threads = threads;
  const Eigen::VectorXf weight = Eigen::VectorXf::Ones(products.transport.rows());
  const Stopwatch watch;
  for (const Products::Stage& stage : products.stages()) {
    options.iterations = stage.iterations;
    const Eigen::MatrixXf start = Eigen::MatrixXf::Ones(products.transport.cols(), stage.channels);
    const lighting::RichardsonLucyResult solved = lighting::richardson_lucy(
        products.transport.topRows(stage.rows), weight.head(stage.rows), products.observed(stage), {}, start, options);
    result.light.emplace_back(solved.estimate.cast<double>());
  }
  result.seconds = watch.seconds();
  return result;
}

double deviation(const Products::Result& a, const Products::Result& b) {
  double largest = 0;
  for (std::size_t s = 0; s < b.light.size(); ++s) {
    const double off = (a.light[s] - b.light[s]).norm() / b.light[s].norm();
    if (!std::isfinite(off)) return off;
    largest = std::max(largest, off);
  }
  return largest;
}

}  // namespace faceprobe::bench
