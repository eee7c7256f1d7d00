#include "eval/report/svg_plot.h"

#include "eval/report/plot_frame.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

// "yang (3 of 100), tan (1 of 100)"
class Shares {
 public:
  void add(const std::string& name, std::size_t count, std::size_t of) {
    if (count == 0) return;
    text_ += (text_.empty() ? "" : ", ") + name + " (" + std::to_string(count) + " of " + std::to_string(of) + ')';
  }
  std::string sentence(const std::string& what) const { return text_.empty() ? "" : what + ": " + text_ + ". "; }

 private:
  std::string text_;
};

bool finite_at(const ReportPlot& plot, const ReportSeries& series, std::size_t i) {
  return std::isfinite(series.values[i]) && (plot.kind != PlotKind::kLines || std::isfinite(series.x[i]));
}

std::size_t finite_count(const ReportPlot& plot, const ReportSeries& series) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < series.values.size(); ++i) count += finite_at(plot, series, i) ? 1 : 0;
  return count;
}

// Finite values that an axis of x, cut short, does not show.
std::size_t beyond_count(const ReportPlot& plot, std::size_t index) {
  if (plot.kind == PlotKind::kBars || (!plot.x_low && !plot.x_high)) return 0;
  if (plot.kind == PlotKind::kHistogram) {
    const std::optional<SharedBins> bins = shared_bins(plot);
    return bins ? bins->beyond[index] : 0;
  }
  const std::optional<Range> range = value_range(plot);
  const ReportSeries& series = plot.series[index];
  const std::vector<double>& x = plot.kind == PlotKind::kLines ? series.x : series.values;
  std::size_t count = 0;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    count += finite_at(plot, series, i) && range && (x[i] < range->low || x[i] > range->high) ? 1 : 0;
  }
  return count;
}

bool has_values(const ReportPlot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(),
                     [&](const ReportSeries& series) { return finite_count(plot, series) > 0; });
}

}  // namespace

void check_plot(const ReportPlot& plot) {
  const std::size_t most = std::max<std::size_t>(1, plot.groups.size());
  for (const ReportSeries& series : plot.series) {
    const std::string place = "the plot \"" + plot.title + "\": series " + series.name + " has ";
    if (plot.kind == PlotKind::kLines && series.x.size() != series.values.size()) {
      throw std::invalid_argument(place + std::to_string(series.x.size()) + " x for " +
                                  std::to_string(series.values.size()) + " values");
    }
    if (plot.kind == PlotKind::kBars && series.values.size() > most) {
      throw std::invalid_argument(place + std::to_string(series.values.size()) + " values for " + std::to_string(most) +
                                  " places of bars");
    }
  }
}

std::string svg_plot(const ReportPlot& plot, const std::string& id) {
  check_plot(plot);
  if (!has_values(plot)) return {};
  switch (plot.kind) {
    case PlotKind::kCumulative: return svg_cumulative(plot, id);
    case PlotKind::kBars: return svg_bars(plot, id);
    case PlotKind::kLines: return svg_lines(plot, id);
    default: return svg_histogram(plot, id);
  }
}

std::string plot_note(const ReportPlot& plot) {
  check_plot(plot);
  Shares missing;
  Shares beyond;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const ReportSeries& series = plot.series[i];
    const std::size_t finite = finite_count(plot, series);
    missing.add(series.name, series.values.size() - finite, series.values.size());
    beyond.add(series.name, beyond_count(plot, i), finite);
  }
  const bool counted = plot.kind == PlotKind::kCumulative && plot.missing_are_largest;
  std::string note = has_values(plot) ? "" : "There are no values to plot. ";
  note += missing.sentence(counted ? "Missing, and counted as larger than all others" : "Missing, and left out");
  note += beyond.sentence("Beyond the ends of the plot");
  if (!note.empty()) note.pop_back();
  return note;
}

}  // namespace faceprobe::eval
