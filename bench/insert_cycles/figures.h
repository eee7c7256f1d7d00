#pragma once
// Errors of pictures, and how they fall with time.

#include "faceprobe/core/image.h"

#include <vector>

namespace faceprobe::bench {

// Two pictures of the same by one renderer, with seeds of their own.
struct Halves {
  Image first, second;
};

// Root mean square of a - b over the mean of `reference`, colours alone, over the pixels where either of the pictures shows anything.
double error_over_mean(const Image& a, const Image& b, const Image& reference);

// The same without noise: the product of two differences, whose noises have nothing to do with one another, is on average the square of
// what they have in common. 0 when that comes out negative.
double error_beyond_noise(const Halves& a, const Halves& b, const Image& reference);
// Of one picture, noise and all, but without the reference's own noise.
double error_against(const Image& picture, const Halves& converged, const Image& reference);

Image mean_of(const Image& a, const Image& b);

// error = scale * seconds^-power, fitted through points (least squares of the logarithms).
struct Decay {
  double scale = 0;
  double power = 0;
  double seconds_to(double error) const;
};
struct TimedError {
  double seconds = 0;
  double error = 0;
};
Decay fit(const std::vector<TimedError>& points);

// The geometric middle of the errors that both reach.
double common_error(const std::vector<TimedError>& a, const std::vector<TimedError>& b);

}  // namespace faceprobe::bench
