#include "eval/markdown.h"
#include "eval/report/plot_frame.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr double kBarRow = 22;
constexpr double kLongestName = 250;

// One bar, or the heading of a group of them.
struct BarRow {
  std::string name;
  std::string figure;  // as text, at the right
  std::size_t series = 0;
  double value = 0;
  std::optional<std::pair<double, double>> interval;
  bool heading = false;
  bool ours = false;
};

bool is_interval(const std::optional<std::pair<double, double>>& interval) {
  return interval && std::isfinite(interval->first) && std::isfinite(interval->second);
}

BarRow bar_row(const ReportSeries& series, std::size_t index, std::size_t group, int decimals) {
  BarRow row{.name = series.name, .figure = "-", .series = index, .value = NAN, .interval = {}, .ours = series.ours};
  if (group >= series.values.size() || !std::isfinite(series.values[group])) return row;
  row.value = series.values[group];
  row.figure = rounded(row.value, decimals);
  if (group < series.intervals.size() && is_interval(series.intervals[group])) {
    row.interval = series.intervals[group];
    row.figure += " [" + rounded(row.interval->first, decimals) + ", " + rounded(row.interval->second, decimals) + ']';
  }
  return row;
}

std::vector<BarRow> bar_rows(const ReportPlot& plot, int decimals) {
  std::vector<BarRow> rows;
  for (std::size_t group = 0; group < std::max<std::size_t>(1, plot.groups.size()); ++group) {
    if (!plot.groups.empty()) {
      rows.push_back({.name = plot.groups[group], .figure = {}, .interval = {}, .heading = true});
    }
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      rows.push_back(bar_row(plot.series[i], i, group, decimals));
    }
  }
  return rows;
}

// Of all bars and their intervals, and 0.
Range bar_range(const ReportPlot& plot) {
  Range range{0, 0};
  const auto take = [&](double v) { range = {std::min(range.low, v), std::max(range.high, v)}; };
  for (const ReportSeries& series : plot.series) {
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      if (!std::isfinite(series.values[i])) continue;
      take(series.values[i]);
      if (i >= series.intervals.size() || !is_interval(series.intervals[i])) continue;
      take(series.intervals[i]->first);
      take(series.intervals[i]->second);
    }
  }
  return range;
}

void draw_bar(SvgCanvas& canvas, const PlotFrame& frame, const BarRow& row, double middle) {
  if (!std::isfinite(row.value)) return;
  const double zero = frame.at_x(0);
  const double end = frame.at_x(row.value);
  canvas.rect(std::min(zero, end), middle - 6, std::abs(end - zero), 12, "bar " + series_class(row.series));
  if (row.interval) {
    const double low = frame.at_x(row.interval->first);
    const double high = frame.at_x(row.interval->second);
    canvas.line(low, middle, high, middle, "whisker");
    canvas.line(low, middle - 4, low, middle + 4, "whisker");
    canvas.line(high, middle - 4, high, middle + 4, "whisker");
  }
  canvas.marker(end, middle, row.series);
}

}  // namespace

std::string svg_bars(const ReportPlot& plot, const std::string& id) {
  const Range range = bar_range(plot);
  const Ticks ticks = nice_ticks(range.low, range.high, 5);
  const std::vector<BarRow> rows = bar_rows(plot, decimals_for(std::max(-range.low, range.high)));
  double names = 0;
  double figures = 0;
  std::vector<std::string> texts;
  for (const BarRow& row : rows) {
    if (!row.heading) names = std::max(names, text_width(row.name));
    figures = std::max(figures, text_width(row.figure));
    texts.push_back(row.heading ? row.name : row.name + ' ' + row.figure);
  }
  names = std::min(names + 12, kLongestName);

  SvgCanvas canvas(kPlotWidth);
  const double height = kBarRow * static_cast<double>(rows.size());
  const PlotFrame frame{.left = names + 10,
                        .top = 4,
                        .right = kPlotWidth - kPlotMargin - figures - 10,
                        .bottom = 4 + height,
                        .x = {ticks.at.front(), ticks.at.back()},
                        .y = {0, 1}};
  draw_x_axis(canvas, frame, ticks, plot.x_label.empty() ? plot.y_label : plot.x_label);
  canvas.line(frame.at_x(0), frame.top, frame.at_x(0), frame.bottom, "axis");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const BarRow& row = rows[i];
    const double middle = frame.top + (static_cast<double>(i) + 0.5) * kBarRow;
    if (row.heading) {
      canvas.text(2, middle + 5, row.name, "strong", Anchor::kStart, frame.right);
      continue;
    }
    const std::string look = row.ours ? "strong" : "";
    canvas.text(names, middle + 4, row.name, look, Anchor::kEnd, names);
    draw_bar(canvas, frame, row, middle);
    canvas.text(kPlotWidth - kPlotMargin, middle + 4, row.figure, look, Anchor::kEnd);
  }
  return canvas.element(frame.bottom + kUnderAxis, id, plot.title, told("Bars of " + plot.x_label, texts));
}

}  // namespace faceprobe::eval
