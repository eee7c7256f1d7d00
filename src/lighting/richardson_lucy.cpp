#include "faceprobe/lighting/richardson_lucy.h"

#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {

namespace {

// Products are split into blocks of fixed size, whatever the number of threads: each block is one single-threaded product, so
// the rounding is the same on 1 and on N threads.
constexpr int kBlock = 192;

int blocks(Eigen::Index size) { return static_cast<int>((size + kBlock - 1) / kBlock); }

Eigen::Index block_size(int block, Eigen::Index size) {
  return std::min<Eigen::Index>(kBlock, size - static_cast<Eigen::Index>(block) * kBlock);
}

void predict(const RowMatrix& transport, const Eigen::MatrixXf& estimate, int threads, Eigen::MatrixXf& predicted) {
  parallel_for(blocks(transport.rows()), threads, [&](int first, int last) {
    for (int b = first; b < last; ++b) {
      const Eigen::Index at = static_cast<Eigen::Index>(b) * kBlock;
      const Eigen::Index n = block_size(b, transport.rows());
      predicted.middleRows(at, n).noalias() = transport.middleRows(at, n) * estimate;
    }
  });
}

void back_project(const RowMatrix& transport, const Eigen::MatrixXf& ratios, int threads, Eigen::MatrixXf& correction) {
  parallel_for(blocks(transport.cols()), threads, [&](int first, int last) {
    for (int b = first; b < last; ++b) {
      const Eigen::Index at = static_cast<Eigen::Index>(b) * kBlock;
      const Eigen::Index n = block_size(b, transport.cols());
      correction.middleRows(at, n).noalias() = transport.middleCols(at, n).transpose() * ratios;
    }
  });
}

}  // namespace

std::string RichardsonLucyOptions::validate() const {
  if (iterations < 0 || iterations > 10'000) return "iterations must be from 0 to 10000.";
  if (!(unobserved_share >= 0) || unobserved_share >= 1) return "unobserved_share must lie in [0, 1).";
  return {};
}

RichardsonLucyResult richardson_lucy(const RowMatrix& transport, const Eigen::VectorXf& weight,
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
  Eigen::MatrixXf weight_column = weight;
  Eigen::MatrixXf sensitivity(transport.cols(), 1);
  back_project(transport, weight_column, options.threads, sensitivity);
  result.sensitivity = sensitivity.col(0);
  const float least = options.unobserved_share * std::max(0.0F, result.sensitivity.maxCoeff());

  Eigen::MatrixXf predicted(transport.rows(), observed.cols());
  Eigen::MatrixXf correction(transport.cols(), observed.cols());
  // Predictions far below anything observed would turn one bad row into a spike; a floor relative to the data keeps the ratio
  // bounded and is too small to matter elsewhere.
  const float floor = std::max(1e-30F, 1e-6F * observed.cwiseAbs().maxCoeff());
  for (int iteration = 0;; ++iteration) {
    if (iteration == options.iterations && !options.track_likelihood) break;
    predict(transport, result.estimate, options.threads, predicted);
    if (options.track_likelihood) {
      double likelihood = 0;
      for (Eigen::Index c = 0; c < observed.cols(); ++c) {
        for (Eigen::Index i = 0; i < observed.rows(); ++i) {
          const double p = std::max(predicted(i, c), floor);
          likelihood += weight[i] * (observed(i, c) * std::log(p) - p);
        }
      }
      result.log_likelihood.push_back(likelihood);
    }
    if (iteration == options.iterations) break;
    for (Eigen::Index c = 0; c < observed.cols(); ++c) {
      for (Eigen::Index i = 0; i < observed.rows(); ++i) {
        float ratio = observed(i, c) / std::max(predicted(i, c), floor);
        if (bounded && lower_bound(i, c)) ratio = std::max(ratio, 1.0F);
        predicted(i, c) = weight[i] * ratio;
      }
    }
    back_project(transport, predicted, options.threads, correction);
    for (Eigen::Index c = 0; c < observed.cols(); ++c) {
      for (Eigen::Index j = 0; j < transport.cols(); ++j) {
        if (result.sensitivity[j] > least) result.estimate(j, c) *= correction(j, c) / result.sensitivity[j];
      }
    }
  }
  return result;
}

}  // namespace faceprobe::lighting
