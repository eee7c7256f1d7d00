#include "eval/report/plot_data.h"

#include "eval/markdown.h"
#include "faceprobe/eval/statistics.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr double kFarthest = 1e300;  // so that no difference overflows
constexpr double kNarrowest = 1e-9;  // of the values: doubles have few steps in less
constexpr double kFewestBins = 8;
constexpr double kMostBins = 30;       // more are thinner than a reader tells apart
constexpr double kLargestPlain = 1e7;  // beyond, and below the next, numbers are written with an exponent
constexpr double kSmallestPlain = 1e-5;

struct Step {
  int mantissa = 1;  // 1, 2 or 5
  int exponent = 0;

  // Divided for negative exponents: 3 / 10 is the double nearest to 0.3, 3 * 0.1 is not.
  double times(double count) const {
    const double power = std::pow(10.0, std::abs(exponent));
    return exponent < 0 ? count * mantissa / power : count * mantissa * power;
  }
};

// The least step that is not below `width`.
Step step_from(double width) {
  Step step{.mantissa = 1, .exponent = static_cast<int>(std::floor(std::log10(width)))};
  while (step.times(1) < width * (1 - 1e-9)) {
    step.mantissa = step.mantissa == 1 ? 2 : step.mantissa == 2 ? 5 : 10;
    if (step.mantissa == 10) {
      step.mantissa = 1;
      ++step.exponent;
    }
  }
  return step;
}

Range opened(double low, double high) {
  if (low > high) std::swap(low, high);
  low = std::clamp(low, -kFarthest, kFarthest);
  high = std::clamp(high, -kFarthest, kFarthest);
  const double size = std::max(std::abs(low), std::abs(high));
  if (size == 0) return {0, 1};
  const double least = std::max(size * kNarrowest, 1e-290);
  if (high - low < least) {
    const double middle = low + (high - low) / 2;
    // A lone value: an axis as wide as it is large, or a hair's breadth where values differ by less than they can.
    const double half = high == low ? size / 2 : least / 2;
    return {middle - half, middle + half};
  }
  return {low, high};
}

// Whole numbers of steps that enclose low and high; a rounding error does not add one.
struct Enclosure {
  double first = 0;
  double last = 1;
};
Enclosure enclose(const Step& step, const Range& range) {
  const double width = step.times(1);
  Enclosure out{std::floor(range.low / width), std::ceil(range.high / width)};
  if (step.times(out.first + 1) <= range.low) ++out.first;
  if (step.times(out.last - 1) >= range.high) --out.last;
  while (step.times(out.first) > range.low) --out.first;
  while (step.times(out.last) < range.high) ++out.last;
  return out;
}

std::string scientific(double value) {
  std::array<char, 32> text;
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 2).ptr};
}

bool is_plain(double size) { return size == 0 || (size >= kSmallestPlain && size < kLargestPlain); }

int exponent_of(double size) { return static_cast<int>(std::floor(std::log10(size))); }

}  // namespace

std::string Ticks::text(double value) const {
  const double size = std::max(std::abs(at.front()), std::abs(at.back()));
  if (!is_plain(size)) return value == 0 ? "0" : scientific(value);
  return rounded(value, std::clamp(-exponent_of(step * (1 + 1e-9)), 0, 15));
}

Ticks nice_ticks(double low, double high, int about) {
  const Range range = opened(low, high);
  const Step step = step_from((range.high - range.low) / std::max(1, about));
  Enclosure ends = enclose(step, range);
  if (ends.first == ends.last) ++ends.last;
  Ticks out{.step = step.times(1), .at = {}};
  for (double i = ends.first; i <= ends.last; ++i) out.at.push_back(step.times(i) + 0.0);  // + 0: no -0
  return out;
}

int decimals_for(double largest) {
  const double size = std::abs(largest);
  return size > 0 && std::isfinite(size) ? std::clamp(2 - exponent_of(size), 0, 12) : 0;
}

std::string three_digits(double value) {
  if (std::isfinite(value) && !is_plain(std::abs(value))) return scientific(value);
  return rounded(value, decimals_for(value));
}

std::vector<double> finite_values(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, 0.5);
}

std::optional<Range> value_range(const ReportPlot& plot) {
  std::optional<Range> found;
  for (const ReportSeries& series : plot.series) {
    for (const double v : finite_values(plot.kind == PlotKind::kLines ? series.x : series.values)) {
      if (!found) found = Range{v, v};
      found = Range{std::min(found->low, v), std::max(found->high, v)};
    }
  }
  if (!found) return found;
  // Errors begin at 0, and so does their axis.
  if (plot.kind != PlotKind::kLines && found->low > 0 && found->low < found->high / 2) found->low = 0;
  if (plot.x_low && std::isfinite(*plot.x_low)) found->low = *plot.x_low;
  if (plot.x_high && std::isfinite(*plot.x_high)) found->high = *plot.x_high;
  return opened(found->low, found->high);
}

std::optional<SharedBins> shared_bins(const ReportPlot& plot) {
  const std::optional<Range> range = value_range(plot);
  if (!range) return std::nullopt;
  std::size_t most = 0;
  for (const ReportSeries& series : plot.series) most = std::max(most, finite_values(series.values).size());
  const double wanted = std::clamp(3 * std::sqrt(static_cast<double>(most)), kFewestBins, kMostBins);
  const Step step = step_from((range->high - range->low) / wanted);
  const Enclosure ends = enclose(step, *range);
  const double low = step.times(ends.first);
  SharedBins out{.low = low, .width = step.times(1), .counts = {}, .beyond = {}};
  const int bins = std::max(1, static_cast<int>(ends.last - ends.first));
  for (const ReportSeries& series : plot.series) {
    // Bins may reach over an end that the plot asks for; they are whole, so values there count.
    const Histogram h = histogram(finite_values(series.values), low, step.times(ends.first + bins), bins);
    out.counts.push_back(h.counts);
    out.beyond.push_back(h.below + h.above);
  }
  return out;
}

std::vector<CurvePoint> cumulative_curve(const std::vector<double>& values, std::size_t missing) {
  std::vector<double> sorted = finite_values(values);
  std::sort(sorted.begin(), sorted.end());
  const auto total = static_cast<double>(sorted.size() + missing);
  std::vector<CurvePoint> out;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i + 1 < sorted.size() && sorted[i + 1] == sorted[i]) continue;
    out.push_back({sorted[i], static_cast<double>(i + 1) / total});
  }
  return out;
}

std::optional<double> reached_at(const std::vector<CurvePoint>& curve, double share) {
  for (const CurvePoint& point : curve) {
    if (point.share >= share) return point.x;
  }
  return std::nullopt;
}

}  // namespace faceprobe::eval
