#include "faceprobe/lighting/richardson_lucy.h"

#include "faceprobe/core/parallel.h"
#include "faceprobe/core/quantile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace faceprobe::lighting {

namespace {

// Rows are worked on in blocks of fixed size, whatever the number of threads: each block is one single-threaded product and the
// blocks' corrections are added in order, so the rounding is the same on 1 and on N threads. A block stays in the cache between
// its two products, which halves the memory traffic that the iteration is bound by.
constexpr int kBlock = 64;

int blocks(Eigen::Index size) { return static_cast<int>((size + kBlock - 1) / kBlock); }

struct Block {
  Eigen::Index at;
  Eigen::Index size;
};

Block block_of(int number, Eigen::Index rows) {
  const Eigen::Index at = static_cast<Eigen::Index>(number) * kBlock;
  return {at, std::min<Eigen::Index>(kBlock, rows - at)};
}

// sum over rows of ratios(block) back through the transport; `ratios` may look at the block's own prediction.
template <class Ratios>
Eigen::MatrixXf back_projected(const Eigen::Ref<const RowMatrix>& transport, Eigen::Index channels, int threads,
                               const Ratios& ratios) {
  std::vector<Eigen::MatrixXf> partial(static_cast<std::size_t>(blocks(transport.rows())));
  parallel_for(static_cast<int>(partial.size()), threads, [&](int first, int last) {
    for (int b = first; b < last; ++b) {
      const Block block = block_of(b, transport.rows());
      const Eigen::MatrixXf values = ratios(block);
      partial[static_cast<std::size_t>(b)].noalias() = transport.middleRows(block.at, block.size).transpose() * values;
    }
  });
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(transport.cols(), channels);
  for (const Eigen::MatrixXf& part : partial) sum += part;
  return sum;
}

float median_above(const Eigen::VectorXf& values, float least) {
  std::vector<float> kept;
  std::copy_if(values.begin(), values.end(), std::back_inserter(kept), [least](float v) { return v > least; });
  return upper_median_of(std::move(kept));
}

}  // namespace

std::string RichardsonLucyOptions::validate() const {
  if (iterations < 0 || iterations > 10'000) return "iterations must be from 0 to 10000.";
  if (!(prior_weight >= 0)) return "prior_weight must not be negative.";
  if (!(unobserved_share >= 0) || unobserved_share >= 1) return "unobserved_share must lie in [0, 1).";
  return {};
}

RichardsonLucyResult richardson_lucy(const Eigen::Ref<const RowMatrix>& transport, const Eigen::VectorXf& weight,
                                     const Eigen::MatrixXf& observed,
                                     const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& lower_bound,
                                     const Eigen::MatrixXf& start, const RichardsonLucyOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const bool bounded = lower_bound.size() > 0;
  if (weight.size() != transport.rows() || observed.rows() != transport.rows() || start.rows() != transport.cols() ||
      start.cols() != observed.cols() ||
      (bounded && (lower_bound.rows() != observed.rows() || lower_bound.cols() != observed.cols()))) {
    throw std::invalid_argument("Richardson-Lucy needs matching rows, columns and channels.");
  }
  RichardsonLucyResult result;
  result.estimate = start;
  const Eigen::Index channels = observed.cols();
  result.sensitivity = back_projected(transport, 1, options.threads,
                                      [&](const Block& b) -> Eigen::MatrixXf { return weight.segment(b.at, b.size); });
  const float least = options.unobserved_share * std::max(0.0F, result.sensitivity.maxCoeff());
  // Beta of each column: the prior stands in for the sensitivity that a column lacks.
  const Eigen::VectorXf prior =
      options.prior_weight * (median_above(result.sensitivity, least) - result.sensitivity.array()).max(0.0F);

  // Predictions far below anything observed would turn one bad row into a spike; a floor relative to the data keeps the ratio
  // bounded and is too small to matter elsewhere.
  const float floor = std::max(1e-30F, 1e-6F * observed.cwiseAbs().maxCoeff());
  std::vector<double> block_likelihood(static_cast<std::size_t>(blocks(transport.rows())));
  const auto ratios = [&](const Block& b) -> Eigen::MatrixXf {
    Eigen::MatrixXf values = transport.middleRows(b.at, b.size) * result.estimate;
    double likelihood = 0;
    for (Eigen::Index c = 0; c < channels; ++c) {
      for (Eigen::Index i = 0; i < b.size; ++i) {
        const float h = observed(b.at + i, c);
        const float p = std::max(values(i, c), floor);
        if (options.track_likelihood) likelihood += weight[b.at + i] * (h * std::log(static_cast<double>(p)) - p);
        float ratio = h / p;
        if (bounded && lower_bound(b.at + i, c)) ratio = std::max(ratio, 1.0F);
        values(i, c) = weight[b.at + i] * ratio;
      }
    }
    block_likelihood[static_cast<std::size_t>(b.at / kBlock)] = likelihood;
    return values;
  };
  for (int iteration = 0;; ++iteration) {
    if (iteration == options.iterations && !options.track_likelihood) break;
    const Eigen::MatrixXf correction = back_projected(transport, channels, options.threads, ratios);
    if (options.track_likelihood) {
      result.log_likelihood.push_back(std::accumulate(block_likelihood.begin(), block_likelihood.end(), 0.0));
    }
    if (iteration == options.iterations) break;
    for (Eigen::Index c = 0; c < channels; ++c) {
      for (Eigen::Index j = 0; j < transport.cols(); ++j) {
        if (result.sensitivity[j] <= least) continue;
        float& e = result.estimate(j, c);
        e = (e * correction(j, c) + prior[j] * start(j, c)) / (result.sensitivity[j] + prior[j]);
      }
    }
  }
  return result;
}

}  // namespace faceprobe::lighting
