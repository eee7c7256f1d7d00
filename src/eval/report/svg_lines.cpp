#include "eval/report/plot_frame.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr std::size_t kMostMarkers = 40;  // more cover the line

struct LinePoint {
  double x = 0, y = 0;
  std::optional<std::pair<double, double>> interval;
  bool known = true;  // a point that is missing breaks the line
};

// Those within the range.
std::vector<LinePoint> line_points(const ReportSeries& series, const Range& range) {
  std::vector<LinePoint> out;
  for (std::size_t i = 0; i < series.values.size(); ++i) {
    LinePoint point{.x = series.x[i], .y = series.values[i], .interval = {}};
    point.known = std::isfinite(point.x) && std::isfinite(point.y);
    if (point.known && (point.x < range.low || point.x > range.high)) continue;
    if (i < series.intervals.size()) point.interval = series.intervals[i];
    if (point.interval && !(std::isfinite(point.interval->first) && std::isfinite(point.interval->second))) {
      point.interval.reset();
    }
    out.push_back(point);
  }
  return out;
}

std::optional<Range> line_heights(const std::vector<std::vector<LinePoint>>& lines) {
  std::optional<Range> found;
  const auto take = [&](double v) {
    found = found ? Range{std::min(found->low, v), std::max(found->high, v)} : Range{v, v};
  };
  for (const std::vector<LinePoint>& points : lines) {
    for (const LinePoint& point : points) {
      if (!point.known) continue;
      take(point.y);
      if (!point.interval) continue;
      take(point.interval->first);
      take(point.interval->second);
    }
  }
  if (found && found->low > 0 && found->low < found->high / 2) found->low = 0;
  return found;
}

void draw_line(SvgCanvas& canvas, const PlotFrame& frame, const std::vector<LinePoint>& points, std::size_t series,
               bool heavy) {
  std::string steps;
  bool begins = true;
  for (const LinePoint& point : points) {
    if (!point.known) {
      begins = true;
      continue;
    }
    steps += begins ? 'M' : 'L';
    begins = false;
    steps += coordinate(frame.at_x(point.x)) + ' ' + coordinate(frame.at_y(point.y));
  }
  if (steps.empty()) return;
  for (const LinePoint& point : points) {
    if (!point.known || !point.interval) continue;
    const double x = frame.at_x(point.x);
    canvas.line(x, frame.at_y(point.interval->first), x, frame.at_y(point.interval->second),
                "spread " + series_class(series));
  }
  canvas.path(steps, "curve", series, heavy);
  if (points.size() > kMostMarkers) return;
  for (const LinePoint& point : points) {
    if (point.known) canvas.marker(frame.at_x(point.x), frame.at_y(point.y), series);
  }
}

}  // namespace

std::string svg_lines(const ReportPlot& plot, const std::string& id) {
  const std::optional<Range> range = value_range(plot);
  if (!range) return {};
  std::vector<std::vector<LinePoint>> lines;
  for (const ReportSeries& series : plot.series) lines.push_back(line_points(series, *range));
  const std::optional<Range> heights = line_heights(lines);
  if (!heights) return {};
  const Ticks x_ticks = nice_ticks(range->low, range->high);
  const Ticks y_ticks = nice_ticks(heights->low, heights->high, 5);
  SvgCanvas canvas(kPlotWidth);
  const PlotFrame frame{
      .left = room_for_y(y_ticks, plot.y_label),
      .top = kPlotMargin,
      .right = right_end(x_ticks),
      .bottom = kPlotMargin + kCurveHeight,
      .x = {plot.x_low ? range->low : x_ticks.at.front(), plot.x_high ? range->high : x_ticks.at.back()},
      .y = {y_ticks.at.front(), y_ticks.at.back()}};
  draw_x_axis(canvas, frame, x_ticks, plot.x_label);
  draw_y_axis(canvas, frame, y_ticks);
  if (!plot.y_label.empty()) canvas.upright_text(kTextLine - 4, (frame.top + frame.bottom) / 2, plot.y_label, "");
  std::vector<std::string> texts;
  for (const ReportSeries& series : plot.series) texts.push_back(series.name);
  for (const std::size_t i : drawing_order(plot.series)) {
    draw_line(canvas, frame, lines[i], i, plot.series[i].ours);
  }
  const double legend = draw_legend(canvas, frame.bottom + kUnderAxis, texts, plot.series);
  return canvas.element(frame.bottom + kUnderAxis + legend, id, plot.title,
                        told(plot.y_label + " over " + plot.x_label, texts));
}

}  // namespace faceprobe::eval
