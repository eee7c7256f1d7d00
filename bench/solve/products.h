#pragma once
// The products that a solve of the transport solver spends its time on, by themselves, so that others can do the same: Richardson-Lucy steps
// (lighting/richardson_lucy.h, plain), ten from the shading alone, fifty from highlights and shading, six of three colours.
//
//   const Products products = make_products(observations, nside, threads);
//   const Products::Result ours = by_library(products, threads);
//   const Products::Result naive = by_double_loop(products);
//   if (deviation(naive, ours) > .01) ...                 // one of them does something else

#include "faceprobe/lighting/observations.h"
#include "faceprobe/lighting/transport.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::bench {

struct Products {
  // T, #rows x #cells: shading rows, then highlight rows. What is seen in each row, #rows x 3, all above 0.
  lighting::RowMatrix transport;
  Eigen::MatrixX3f seen;
  int shading_rows = 0;

  // One run of steps e <- e T'(h / Te) / T'1 on the first `rows` rows, from e = 1; of the luminance where channels is 1.
  struct Stage {
    int rows, iterations, channels;
  };
  std::vector<Stage> stages() const;
  // h of a stage, #rows x #channels.
  Eigen::MatrixXf observed(const Stage& stage) const;
  double multiplications() const;  // of all stages

  struct Result {
    double seconds = 0;
    std::vector<Eigen::MatrixXd> light;  // of each stage, #cells x #channels
  };
};

Products make_products(const lighting::Observations& observations, int nside, int threads);

Products::Result by_library(const Products& products, int threads);
// Dense loops over rows and cells in double precision, on one thread.
Products::Result by_double_loop(const Products& products);

// Root of the mean squared difference of their lights over that of the second, the largest of the stages; not finite where one of them is not.
double deviation(const Products::Result& a, const Products::Result& b);

}  // namespace faceprobe::bench
