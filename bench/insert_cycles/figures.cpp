#include "insert_cycles/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faceprobe::bench {

namespace {

// Root of the mean of (a - b) (c - d), over the mean of `reference`.
double root_of_products(const Image& a, const Image& b, const Image& c, const Image& d, const Image& reference) {
  double products = 0;
  double sum = 0;
  double count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (!(a(x, y, 3) > 0) && !(b(x, y, 3) > 0)) continue;
      for (int k = 0; k < 3; ++k) {
        products += static_cast<double>(a(x, y, k) - b(x, y, k)) * static_cast<double>(c(x, y, k) - d(x, y, k));
        sum += static_cast<double>(reference(x, y, k));
        count += 1;
      }
    }
  }
  return std::sqrt(std::max(0.0, products / count)) / (sum / count);
}

}  // namespace

double error_over_mean(const Image& a, const Image& b, const Image& reference) {
  return root_of_products(a, b, a, b, reference);
}

double error_beyond_noise(const Halves& a, const Halves& b, const Image& reference) {
  return root_of_products(a.first, b.first, a.second, b.second, reference);
}

double error_against(const Image& picture, const Halves& converged, const Image& reference) {
  return root_of_products(picture, converged.first, picture, converged.second, reference);
}

Image mean_of(const Image& a, const Image& b) {
  Image out = a;
  for (std::size_t i = 0; i < out.values().size(); ++i) out.values()[i] = 0.5F * (a.values()[i] + b.values()[i]);
  return out;
}

double Decay::seconds_to(double error) const { return std::pow(scale / error, 1 / power); }

Decay fit(const std::vector<TimedError>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const TimedError& point : points) {
    x += std::log(point.seconds);
    y += std::log(point.error);
    xx += std::log(point.seconds) * std::log(point.seconds);
    xy += std::log(point.seconds) * std::log(point.error);
  }
  const auto n = static_cast<double>(points.size());
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {std::exp((y - slope * x) / n), -slope};
}

double common_error(const std::vector<TimedError>& a, const std::vector<TimedError>& b) {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
  for (const auto* points : {&a, &b}) {
    const auto [low, high] = std::minmax_element(
        points->begin(), points->end(), [](const TimedError& p, const TimedError& q) { return p.error < q.error; });
    least = std::max(least, low->error);
    most = std::min(most, high->error);
  }
  return std::sqrt(least * most);
}

}  // namespace faceprobe::bench
