#pragma once
// Internal: rows of observations explained by a surround of a few shapes and one light more, none of them negative, by a loss that outliers hardly
// move and that likelihoods can be compared by (compact_fit.h).
//
//   const RowsFit fit = fit_rows(rows, column);    // rows.data ~ rows.surround * x + column * x[kSurround]

#include <Eigen/Core>

namespace faceprobe::lighting {

inline constexpr int kSurround = 7;              // the map without the light; then smooth light from six sides
inline constexpr int kUnknowns = kSurround + 1;  // and the light

using SurroundColumns = Eigen::Matrix<double, Eigen::Dynamic, kSurround>;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using UnknownsMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

struct RobustRows {
  SurroundColumns surround;                     // #rows x kSurround
  Eigen::VectorXd data;                         // #rows
  Eigen::VectorXd weight;                       // #rows, 0 or more
  Eigen::Array<bool, Eigen::Dynamic, 1> bound;  // #rows: the datum is a lower bound
  double scale = 1;                             // of the residuals, standard deviation
  double independent = 1;                       // how many independent rows these are worth
};

struct RowsFit {
  Unknowns x = Unknowns::Zero();
  Eigen::VectorXd residual;   // #rows, prediction - data; 0 where a bound is kept
  Eigen::VectorXd influence;  // #rows: weight, less for outliers, 0 where a bound is kept
  double cost = 0;            // -2 log likelihood, but for a constant
};

// The x >= 0 that minimises x' h x - 2 g' x, by the active set method of Lawson & Hanson 1974. `h`: symmetric, positive semidefinite. An unknown
// whose diagonal is 0 stays 0.
Unknowns non_negative_solution(const UnknownsMatrix& h, const Unknowns& g);

// What fit_rows believes of x before it sees rows, as the inverse of variances: the map about as it is, little smooth light, any light.
Unknowns prior_precision();

// `light`: #rows, what a light of irradiance 1 adds.
RowsFit fit_rows(const RobustRows& rows, const Eigen::VectorXd& light);

// 1.48 times the weighted median of the residuals' sizes, at least a five-hundredth of the data.
double robust_scale(const RobustRows& rows, const Eigen::VectorXd& residual);
// Residuals of neighbours are alike where normals and layers are wrong, and alike rows are no new evidence: the weight squared over the weighted sum of
// correlations, which are taken as a function of the angle between normals (#rows x 3, unit) out to where they end.
double independent_rows(const RobustRows& rows, const Eigen::VectorXd& residual, const Eigen::MatrixX3f& normals);

}  // namespace faceprobe::lighting
