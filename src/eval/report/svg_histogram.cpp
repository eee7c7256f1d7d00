#include "eval/markdown.h"
#include "eval/report/plot_frame.h"

#include <algorithm>

namespace faceprobe::eval {
namespace {

constexpr double kPanelHeight = 58;

std::string count_text(const ReportSeries& series, const std::vector<double>& values) {
  return "n = " + counted(values.size(), series.values.size() - values.size());
}

void draw_panel(SvgCanvas& canvas, const PlotFrame& frame, const SharedBins& bins, std::size_t series, double median) {
  for (std::size_t bin = 0; bin < bins.counts[series].size(); ++bin) {
    const auto count = static_cast<double>(bins.counts[series][bin]);
    if (count == 0) continue;
    const double left = bins.low + static_cast<double>(bin) * bins.width;
    const double x1 = frame.at_x(left);
    const double x2 = frame.at_x(left + bins.width);
    canvas.rect(x1 + 0.5, frame.at_y(count), x2 - x1 - 1, frame.bottom - frame.at_y(count),
                "bar " + series_class(series));
  }
  canvas.line(frame.left, frame.bottom, frame.right, frame.bottom, "axis");
  if (!(median >= frame.x.low && median <= frame.x.high)) return;
  canvas.line(frame.at_x(median), frame.top, frame.at_x(median), frame.bottom, "median " + series_class(series));
  canvas.marker(frame.at_x(median), frame.top, series);
}

}  // namespace

std::string svg_histogram(const ReportPlot& plot, const std::string& id) {
  const std::optional<SharedBins> bins = shared_bins(plot);
  if (!bins) return {};
  std::size_t highest = 0;
  for (const std::vector<std::size_t>& counts : bins->counts) {
    highest = std::max(highest, *std::max_element(counts.begin(), counts.end()));
  }
  const double high = bins->low + static_cast<double>(bins->counts.front().size()) * bins->width;
  // Whole numbers: no more steps than there are counts.
  const int steps = static_cast<int>(std::clamp<std::size_t>(highest, 1, 2));
  const Ticks y_ticks = nice_ticks(0, static_cast<double>(std::max<std::size_t>(1, highest)), steps);
  const Ticks x_ticks = nice_ticks(bins->low, high);
  const std::string label = plot.y_label.empty() ? "count" : plot.y_label;

  SvgCanvas canvas(kPlotWidth);
  PlotFrame frame{.left = room_for_y(y_ticks, label),
                  .right = right_end(x_ticks),
                  .x = {bins->low, high},
                  .y = {0, y_ticks.at.back()}};
  std::vector<std::string> texts;
  double y = 0;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const std::vector<double> values = finite_values(plot.series[i].values);
    const double median = median_of(values);
    texts.push_back(plot.series[i].name + ": " + count_text(plot.series[i], values) +
                    (values.empty() ? "" : ", median " + three_digits(median)));
    canvas.text(frame.left, y + 14, texts.back(), plot.series[i].ours ? "strong" : "", Anchor::kStart,
                frame.right - frame.left);
    frame.top = y + 26;
    frame.bottom = frame.top + kPanelHeight;
    if (i + 1 < plot.series.size()) {
      for (const double tick : x_ticks.at) {
        if (tick <= high) canvas.line(frame.at_x(tick), frame.top, frame.at_x(tick), frame.bottom, "grid");
      }
    } else {
      draw_x_axis(canvas, frame, x_ticks, plot.x_label);
    }
    draw_y_axis(canvas, frame, y_ticks);
    draw_panel(canvas, frame, *bins, i, median);
    y = frame.bottom + 8;
  }
  canvas.upright_text(kTextLine - 4, frame.bottom / 2, label, "");
  return canvas.element(frame.bottom + kUnderAxis, id, plot.title, told("Histogram of " + plot.x_label, texts));
}

}  // namespace faceprobe::eval
