#pragma once
// Internal: the axes of a plot, and one function for each kind of it. They return the whole SVG element, or an empty string where there is nothing
// to draw.

#include "eval/report/plot_data.h"
#include "eval/report/svg_canvas.h"

#include <string>
#include <vector>

namespace faceprobe::eval {

inline constexpr double kPlotWidth = 640;
inline constexpr double kPlotMargin = 12;  // to the right, and above
inline constexpr double kUnderAxis = 44;   // of an axis' numbers and its label
inline constexpr double kTextLine = 18;
inline constexpr double kCurveHeight = 250;

// Where values lie on the canvas.
struct PlotFrame {
  double left = 0, top = 0, right = 0, bottom = 0;
  Range x, y;

  double at_x(double value) const { return left + (value - x.low) / (x.high - x.low) * (right - left); }
  double at_y(double value) const { return bottom - (value - y.low) / (y.high - y.low) * (bottom - top); }
};

// Room that the numbers of an axis of y take, with its label when it has one.
double room_for_y(const Ticks& ticks, const std::string& label);
// Where a plot ends, so that the last number of its axis of x is whole.
double right_end(const Ticks& ticks);
// Grid, numbers and label; ticks outside the frame are left out.
void draw_x_axis(SvgCanvas& canvas, const PlotFrame& frame, const Ticks& ticks, const std::string& label);
void draw_y_axis(SvgCanvas& canvas, const PlotFrame& frame, const Ticks& ticks);
// One entry a series, `texts` beside its swatch, from y down. Returns how high it is.
double draw_legend(SvgCanvas& canvas, double y, const std::vector<std::string>& texts,
                   const std::vector<ReportSeries>& series);
// Indices of the series, in the order in which they are drawn: ours last, and so above.
std::vector<std::size_t> drawing_order(const std::vector<ReportSeries>& series);
// The texts in one sentence each, for the description of a plot.
std::string told(const std::string& what, const std::vector<std::string>& texts);

std::string svg_histogram(const ReportPlot& plot, const std::string& id);
std::string svg_cumulative(const ReportPlot& plot, const std::string& id);
std::string svg_bars(const ReportPlot& plot, const std::string& id);
std::string svg_lines(const ReportPlot& plot, const std::string& id);

}  // namespace faceprobe::eval
