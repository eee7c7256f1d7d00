#include "eval/report/plot_frame.h"

#include <algorithm>

namespace faceprobe::eval {
namespace {

constexpr double kUnderNumber = 4;  // from the middle of digits to their baseline
constexpr double kLegendText = 50;  // from an entry's left to its text

bool inside(const Range& range, double value) {
  const double slack = (range.high - range.low) * 1e-9;
  return value >= range.low - slack && value <= range.high + slack;
}

}  // namespace

double room_for_y(const Ticks& ticks, const std::string& label) {
  double widest = 0;
  for (const double tick : ticks.at) widest = std::max(widest, text_width(ticks.text(tick)));
  return widest + 10 + (label.empty() ? 0 : kTextLine + 2);
}

double right_end(const Ticks& ticks) {
  return kPlotWidth - std::max(kPlotMargin, text_width(ticks.text(ticks.at.back())) / 2);
}

void draw_x_axis(SvgCanvas& canvas, const PlotFrame& frame, const Ticks& ticks, const std::string& label) {
  for (const double tick : ticks.at) {
    if (!inside(frame.x, tick)) continue;
    const double x = frame.at_x(tick);
    canvas.line(x, frame.top, x, frame.bottom, "grid");
    canvas.text(x, frame.bottom + 17, ticks.text(tick), "dim", Anchor::kMiddle);
  }
  canvas.line(frame.left, frame.bottom, frame.right, frame.bottom, "axis");
  canvas.text((frame.left + frame.right) / 2, frame.bottom + 37, label, "", Anchor::kMiddle, frame.right - frame.left);
}

void draw_y_axis(SvgCanvas& canvas, const PlotFrame& frame, const Ticks& ticks) {
  for (const double tick : ticks.at) {
    if (!inside(frame.y, tick)) continue;
    const double y = frame.at_y(tick);
    canvas.line(frame.left, y, frame.right, y, "grid");
    canvas.text(frame.left - 6, y + kUnderNumber, ticks.text(tick), "dim", Anchor::kEnd);
  }
}

double draw_legend(SvgCanvas& canvas, double y, const std::vector<std::string>& texts,
                   const std::vector<ReportSeries>& series) {
  double widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, text_width(text));
  const std::size_t columns = kLegendText + widest + 2 * kPlotMargin < canvas.width() / 2 ? 2 : 1;
  const double column = (canvas.width() - 2 * kPlotMargin) / static_cast<double>(columns);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const double left = kPlotMargin + static_cast<double>(i % columns) * column;
    const double middle = y + (static_cast<double>(i / columns) + 0.5) * (kTextLine + 2);
    canvas.swatch(left, middle, i, series[i].ours);
    canvas.text(left + kLegendText, middle + kUnderNumber, texts[i], series[i].ours ? "strong" : "", Anchor::kStart,
                column - kLegendText);
  }
  return static_cast<double>((texts.size() + columns - 1) / columns) * (kTextLine + 2);
}

std::vector<std::size_t> drawing_order(const std::vector<ReportSeries>& series) {
  std::vector<std::size_t> order(series.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return !series[i].ours; });
  return order;
}

std::string told(const std::string& what, const std::vector<std::string>& texts) {
  std::string out = what + '.';
  for (const std::string& text : texts) out += ' ' + text + '.';
  return out;
}

}  // namespace faceprobe::eval
