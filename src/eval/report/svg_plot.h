#pragma once
// Internal: a plot as an SVG element for a page with the style sheet of html.h.

#include "faceprobe/eval/paper_report.h"

#include <string>

namespace faceprobe::eval {

// Empty where there is no value to plot. `id` is unique in the page. Throws std::invalid_argument as check_plot does.
std::string svg_plot(const ReportPlot& plot, const std::string& id);

// Which values are not in the picture, or that there are none; empty where all are.
std::string plot_note(const ReportPlot& plot);

// Throws std::invalid_argument, naming the plot, unless x of kLines are as many as values, and values of kBars are not more than groups (or one).
void check_plot(const ReportPlot& plot);

}  // namespace faceprobe::eval
