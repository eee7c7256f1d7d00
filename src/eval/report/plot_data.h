#pragma once
// Internal: what a plot shows, in numbers; no drawing.
//
//   const Ticks ticks = nice_ticks(0.3, 41);       // 0, 10 .. 50
//   const SharedBins bins = shared_bins(plot);     // counts of each series
//   const auto curve = cumulative_curve({1, 2});   // (1, 0.5), (2, 1)

#include "faceprobe/eval/paper_report.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::eval {

// Multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 1;
  std::vector<double> at;  // ascending, two at least; the first is not above `low`, the last not below `high`

  std::string text(double value) const;  // no more digits than the step needs
};
// About `about` of them, for finite numbers; the order of low and high does not matter.
Ticks nice_ticks(double low, double high, int about = 6);

// Three digits that count, in any locale: "0.0123", "12.3", "1230".
std::string three_digits(double value);
// `decimals` for a column of numbers of which this is the largest, so that it has three digits that count.
int decimals_for(double largest);

std::vector<double> finite_values(const std::vector<double>& values);  // in their order
double median_of(std::vector<double> values);

struct Range {
  double low = 0;
  double high = 1;
};
// Of the finite values of all series, with 0 where they begin near it; the plot's own ends count more. Nothing where there are no values.
std::optional<Range> value_range(const ReportPlot& plot);

struct SharedBins {
  double low = 0;
  double width = 1;
  std::vector<std::vector<std::size_t>> counts;  // of each series, from low up
  std::vector<std::size_t> beyond;               // of each series: finite values outside all bins
};
// Nothing where there are no values.
std::optional<SharedBins> shared_bins(const ReportPlot& plot);

struct CurvePoint {
  double x = 0;
  double share = 0;  // of the values that are not above x, 0..1
};
// A point at each value that occurs, ascending. `missing` more values are larger than all; those that are not finite are left out.
std::vector<CurvePoint> cumulative_curve(const std::vector<double>& values, std::size_t missing = 0);
// The least value that so large a share of the curve does not exceed; nothing where it never gets there.
std::optional<double> reached_at(const std::vector<CurvePoint>& curve, double share);

}  // namespace faceprobe::eval
