#include "eval/report/plot_frame.h"

namespace faceprobe::eval {
namespace {

constexpr double kMarkShare = 0.75;

// Steps that lie on the same tenth of a unit are drawn once.
void draw_steps(SvgCanvas& canvas, const PlotFrame& frame, const std::vector<CurvePoint>& curve, std::size_t series,
                bool heavy) {
  double share = 0;
  std::string steps;
  std::string last;
  for (const CurvePoint& point : curve) {
    if (point.x > frame.x.high) break;
    if (point.x >= frame.x.low) {
      if (steps.empty()) steps = 'M' + coordinate(frame.left) + ' ' + coordinate(frame.at_y(share));
      const std::string x = coordinate(frame.at_x(point.x));
      const std::string rise = 'V' + coordinate(frame.at_y(point.share));
      if (x == last) steps.resize(steps.rfind('V'));
      if (x != last) steps.append(1, 'H').append(x);
      steps += rise;
      last = x;
    }
    share = point.share;
  }
  if (steps.empty()) steps = 'M' + coordinate(frame.left) + ' ' + coordinate(frame.at_y(share));
  canvas.path(steps + 'H' + coordinate(frame.right), "curve", series, heavy);
}

void draw_mark(SvgCanvas& canvas, const PlotFrame& frame, const std::vector<CurvePoint>& curve, std::size_t series) {
  const std::optional<double> mark = reached_at(curve, kMarkShare);
  if (!mark || *mark < frame.x.low || *mark > frame.x.high) return;
  const double x = frame.at_x(*mark);
  canvas.line(x, frame.at_y(kMarkShare), x, frame.bottom, "drop " + series_class(series));
  canvas.marker(x, frame.at_y(kMarkShare), series);
}

std::string mark_text(const ReportSeries& series, const std::vector<CurvePoint>& curve) {
  const std::optional<double> mark = reached_at(curve, kMarkShare);
  const std::size_t finite = finite_values(series.values).size();
  return series.name + ": " + (mark ? "75 % within " + three_digits(*mark) : std::string("75 % is not reached")) +
         " (n = " + std::to_string(finite) +
         (finite < series.values.size() ? ", " + std::to_string(series.values.size() - finite) + " missing)" : ")");
}

void draw_share_axis(SvgCanvas& canvas, const PlotFrame& frame) {
  for (const int percent : {0, 25, 50, 75, 100}) {
    const double y = frame.at_y(percent / 100.0);
    canvas.line(frame.left, y, frame.right, y, percent == 75 ? "mark" : "grid");
    canvas.text(frame.left - 6, y + 4, std::to_string(percent) + " %", "dim", Anchor::kEnd);
  }
}

}  // namespace

std::string svg_cumulative(const ReportPlot& plot, const std::string& id) {
  const std::optional<Range> range = value_range(plot);
  if (!range) return {};
  const Ticks ticks = nice_ticks(range->low, range->high);
  const std::string label = plot.y_label.empty() ? "share of the values" : plot.y_label;
  SvgCanvas canvas(kPlotWidth);
  const PlotFrame frame{.left = 76,
                        .top = kPlotMargin,
                        .right = right_end(ticks),
                        .bottom = kPlotMargin + kCurveHeight,
                        .x = {plot.x_low ? range->low : ticks.at.front(), plot.x_high ? range->high : ticks.at.back()},
                        .y = {0, 1}};
  draw_x_axis(canvas, frame, ticks, plot.x_label);
  draw_share_axis(canvas, frame);
  canvas.upright_text(kTextLine - 4, (frame.top + frame.bottom) / 2, label, "");
  std::vector<std::vector<CurvePoint>> curves;
  std::vector<std::string> texts;
  for (const ReportSeries& series : plot.series) {
    const std::size_t missing = series.values.size() - finite_values(series.values).size();
    curves.push_back(cumulative_curve(series.values, plot.missing_are_largest ? missing : 0));
    texts.push_back(mark_text(series, curves.back()));
  }
  for (const std::size_t i : drawing_order(plot.series)) {
    if (curves[i].empty()) continue;
    draw_steps(canvas, frame, curves[i], i, plot.series[i].ours);
    draw_mark(canvas, frame, curves[i], i);
  }
  const double legend = draw_legend(canvas, frame.bottom + kUnderAxis, texts, plot.series);
  return canvas.element(frame.bottom + kUnderAxis + legend, id, plot.title,
                        told("Cumulative curves of " + plot.x_label, texts));
}

}  // namespace faceprobe::eval
