#pragma once
// Summaries of a list of numbers. All are NaN for an empty list, which tables print as a dash.

#include <string>
#include <vector>

namespace faceprobe::bench {

double mean(const std::vector<double>& values);
// p in [0, 1]; linear between the two nearest ranks.
double quantile(std::vector<double> values, double p);
inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }
// Part of the values under the limit, 0..1.
double share_below(const std::vector<double>& values, double limit);

// "12.3", or "-" for NaN.
std::string cell(double value, int decimals = 1);

}  // namespace faceprobe::bench
