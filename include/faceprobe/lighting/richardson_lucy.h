#pragma once
// Richardson-Lucy deconvolution for any non-negative linear model p = T e (Richardson 1972; Lucy 1974; as expectation
// maximisation of the Poisson likelihood, Shepp & Vardi 1982):
//
//   e_j <- e_j  [ sum_i a_i T_ij h_i / p_i ] / [ sum_i a_i T_ij ]
//
// Estimates stay non-negative, the weighted sum of the predictions equals that of the data after every step, and the likelihood never falls (with
// plain data: no bounds, no prior, no column held). Observations that are only lower bounds (clipped pixels) pull upwards while p_i < h_i and are
// silent after.
//
// With prior_weight > 0 a column that is observed less than the median one also has a gamma prior whose mode is its start value (the
// posterior's EM step),
//
//   e_j <- ( e_j sum_i a_i T_ij h_i / p_i + beta_j e_j^start ) / ( sum_i a_i T_ij + beta_j ),
//   beta_j = prior_weight max(0, median sensitivity - sum_i a_i T_ij),
//
// so that a column which the data hardly reach stays near its start instead of soaking up what nothing else explains.
//
// Not for signed data or signed transport.

#include "faceprobe/lighting/transport.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace faceprobe::lighting {

struct RichardsonLucyOptions {
  int iterations = 50;
  // Columns whose sum of a_i T_ij is below this share of the largest are left at the start value: nothing observes them.
  float unobserved_share = 1e-3F;
  // Strength of the prior on weakly observed columns; 0 = plain Richardson-Lucy.
  float prior_weight = 0.0F;
  bool track_likelihood = false;  // costs a logarithm per observation and iteration
  int threads = 0;

  std::string validate() const;
};

struct RichardsonLucyResult {
  Eigen::MatrixXf estimate;            // #columns x #channels
  Eigen::VectorXf sensitivity;         // #columns: sum_i a_i T_ij
  std::vector<double> log_likelihood;  // before each step and after the last: sum a (h log p - p), prior left out
};

// `transport`: #rows x #columns, >= 0. `weight`: #rows. `observed`: #rows x #channels, >= 0. `lower_bound`: the same shape, or
// empty. `start`: #columns x #channels, > 0. Bitwise the same for any number of threads.
// Throws std::invalid_argument when the shapes disagree or the options do not validate.
RichardsonLucyResult richardson_lucy(const Eigen::Ref<const RowMatrix>& transport, const Eigen::VectorXf& weight,
                                     const Eigen::MatrixXf& observed,
                                     const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& lower_bound,
                                     const Eigen::MatrixXf& start, const RichardsonLucyOptions& options);

}  // namespace faceprobe::lighting
