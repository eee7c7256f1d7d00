#pragma once
// The discrete Gaussian: e^-t I_n(t), I_n the modified Bessel functions, t the variance in pixels^2 (Lindeberg 1990, "Scale-space
// for discrete signals", PAMI 12). Unlike samples of the continuous one its variance is exact down to 0, and two of them in a
// row are a third of summed variance.
//
//   const std::vector<double> half = gaussian_kernel(1.2);             // half[n] weighs the pixels n away, on either side

#include <vector>

namespace faceprobe::insert {

inline constexpr float kLargestSigma = 64;

// half[0] + 2 (half[1] + ...) = 1. `sigma_px`: 0 .. a few times kLargestSigma.
std::vector<double> gaussian_kernel(double sigma_px);

}  // namespace faceprobe::insert
