#include "eval/report/svg_plot.h"

#include "eval/report/plot_data.h"
#include "eval/report/svg_canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace faceprobe::eval {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t occurrences(const std::string& text, const std::string& of) {
  std::size_t count = 0;
  for (std::size_t at = text.find(of); at != std::string::npos; at = text.find(of, at + of.size())) ++count;
  return count;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(NiceTicks, CoverTheRangeInStepsOf125) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{0, 1},
                                                                        {0.3, 41},
                                                                        {-3.7, 12.2},
                                                                        {0, 0.0007},
                                                                        {-5, -1},
                                                                        {1e-12, 3e-12},
                                                                        {123456, 987654},
                                                                        {0.81, 0.94},
                                                                        {0, 180},
                                                                        {-1e308, 1e308}}) {
    const Ticks ticks = nice_ticks(low, high);
    ASSERT_GE(ticks.at.size(), 2U) << low << ' ' << high;
    EXPECT_LE(ticks.at.size(), 9U) << low << ' ' << high;
    // No difference of two doubles may overflow, so what is beyond 1e300 counts as that.
    EXPECT_LE(ticks.at.front(), std::max(low, -1e300)) << low << ' ' << high;
    EXPECT_GE(ticks.at.back(), std::min(high, 1e300)) << low << ' ' << high;
    const double mantissa = ticks.step / std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
        << ticks.step;  // 1e-6: of the division by a power of ten
    for (std::size_t i = 1; i < ticks.at.size(); ++i) {
      EXPECT_NEAR((ticks.at[i] - ticks.at[i - 1]) / ticks.step, 1, 1e-6);  // the same division
    }
  }
}

TEST(NiceTicks, AreTheNearestDoublesAndReadAsTheyShould) {
  const Ticks tenths = nice_ticks(0, 0.5, 5);
  EXPECT_EQ(tenths.at, (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(tenths.text(0.3), "0.3");
  EXPECT_EQ(nice_ticks(0, 41).at, (std::vector<double>{0, 10, 20, 30, 40, 50}));
  EXPECT_EQ(nice_ticks(0, 41).text(10), "10");
  EXPECT_EQ(nice_ticks(-1, 1, 4).at, (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(nice_ticks(1, -1, 4).at, nice_ticks(-1, 1, 4).at);
}

TEST(NiceTicks, ALoneValueHasAnAxisToo) {
  for (const double value : {0.0, 5.0, -0.002, 1e-300, 1e305}) {
    const Ticks ticks = nice_ticks(value, value);
    ASSERT_GE(ticks.at.size(), 2U) << value;
    EXPECT_LT(ticks.at.front(), ticks.at.back()) << value;
  }
}

TEST(Digits, ThreeThatCount) {
  EXPECT_EQ(three_digits(0), "0");
  EXPECT_EQ(three_digits(12.345), "12.3");
  EXPECT_EQ(three_digits(-0.012345), "-0.0123");
  EXPECT_EQ(three_digits(12345), "12345");
  EXPECT_EQ(three_digits(2.5e9), "2.50e+09");
  EXPECT_EQ(three_digits(kNan), "-");
}

TEST(SharedBins, HoldEveryValueOnce) {
  ReportPlot plot{.title = "t", .series = {{.name = "a"}, {.name = "b", .values = {1, 1, 7, kNan, INFINITY}}}};
  for (int i = 0; i < 100; ++i) plot.series[0].values.push_back(0.1 * i);
  const std::optional<SharedBins> bins = shared_bins(plot);
  ASSERT_TRUE(bins);
  ASSERT_EQ(bins->counts.size(), 2U);
  EXPECT_EQ(bins->counts[0].size(), bins->counts[1].size());
  EXPECT_EQ(std::accumulate(bins->counts[0].begin(), bins->counts[0].end(), std::size_t{0}), 100U);
  EXPECT_EQ(std::accumulate(bins->counts[1].begin(), bins->counts[1].end(), std::size_t{0}), 3U);
  EXPECT_EQ(bins->beyond, (std::vector<std::size_t>{0, 0}));
  // 3 sqrt(100) = 30 bins are wanted of 0 .. 9.9: the next round width is 0.5.
  EXPECT_EQ(bins->low, 0);
  EXPECT_EQ(bins->width, 0.5);
  EXPECT_EQ(bins->counts[0], std::vector<std::size_t>(20, 5));
  EXPECT_EQ(bins->counts[1][2], 2U);   // 1 is the border of [1, 1.5)
  EXPECT_EQ(bins->counts[1][14], 1U);  // 7
}

TEST(SharedBins, CountWhatLiesBeyondTheEnds) {
  const ReportPlot plot{.title = "t", .series = {{.name = "a", .values = {1, 2, 3, 50, 60}}}, .x_low = 0, .x_high = 10};
  const std::optional<SharedBins> bins = shared_bins(plot);
  ASSERT_TRUE(bins);
  EXPECT_EQ(bins->beyond, (std::vector<std::size_t>{2}));
  EXPECT_EQ(std::accumulate(bins->counts[0].begin(), bins->counts[0].end(), std::size_t{0}), 3U);
  EXPECT_EQ(plot_note(plot), "Beyond the ends of the plot: a (2 of 5).");
}

TEST(Cumulative, CurveByHand) {
  const std::vector<CurvePoint> curve = cumulative_curve({4, 2, kNan, 1, 3});
  ASSERT_EQ(curve.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(curve[i].x, static_cast<double>(i + 1));
    EXPECT_EQ(curve[i].share, static_cast<double>(i + 1) / 4);
  }
  EXPECT_EQ(reached_at(curve, 0.75), 3);
  EXPECT_EQ(reached_at(curve, 0.76), 4);
  // Equal values are one step: 2 of 3 are not above 5.
  const std::vector<CurvePoint> steps = cumulative_curve({5, 5, 9});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].share, 2.0 / 3);
  // Of five samples one failed: four values reach 80 %.
  const std::vector<CurvePoint> failed = cumulative_curve({1, 2, 3, 4}, 1);
  EXPECT_EQ(failed.back().share, 0.8);
  EXPECT_EQ(reached_at(failed, 0.75), 4);
  EXPECT_EQ(reached_at(failed, 0.9), std::nullopt);
  EXPECT_TRUE(cumulative_curve({kNan}).empty());
}

// The path is made by hand: x from 0 to 4 over the 552 units between 76 and 628, shares over the 250 between 262 and 12.
TEST(Cumulative, PathGoesThroughThosePoints) {
  const std::string svg = svg_plot(
      {.title = "t", .x_label = "x", .kind = PlotKind::kCumulative, .series = {{.name = "a", .values = {1, 2, 3, 4}}}},
      "p");
  EXPECT_TRUE(has(svg, "d=\"M76 262H214V199.5H352V137H490V74.5H628V12H628\"")) << svg;
  EXPECT_TRUE(has(svg, "<line class=\"drop s0\" x1=\"490\" y1=\"74.5\" x2=\"490\" y2=\"262\"/>")) << svg;
  EXPECT_TRUE(has(svg, ">a: 75 % within 3.00 (n = 4)</text>")) << svg;
}

TEST(Cumulative, MissingValuesAreLeftOutOrLargest) {
  ReportPlot plot{.title = "t", .kind = PlotKind::kCumulative, .series = {{.name = "a", .values = {1, 2, kNan, kNan}}}};
  EXPECT_TRUE(has(svg_plot(plot, "p"), "a: 75 % within 2.00 (n = 2, 2 missing)"));
  EXPECT_EQ(plot_note(plot), "Missing, and left out: a (2 of 4).");
  plot.missing_are_largest = true;
  EXPECT_TRUE(has(svg_plot(plot, "p"), "a: 75 % is not reached (n = 2, 2 missing)"));
  EXPECT_EQ(plot_note(plot), "Missing, and counted as larger than all others: a (2 of 4).");
}

TEST(Bars, AreAsLongAsTheirValues) {
  const ReportPlot plot{.title = "t",
                        .x_label = "x",
                        .kind = PlotKind::kBars,
                        .series = {{.name = "a", .values = {2}, .intervals = {std::pair(1.0, 3.0)}},
                                   {.name = "b", .values = {4}},
                                   {.name = "c", .values = {kNan}}}};
  const std::string svg = svg_plot(plot, "p");
  ASSERT_EQ(occurrences(svg, "class=\"bar "), 2U);
  const auto width = [&](const std::string& look) {
    const std::size_t at = svg.find(" width=\"", svg.find(look)) + 8;
    return std::stod(svg.substr(at, svg.find('"', at) - at));
  };
  EXPECT_NEAR(width("bar s1") / width("bar s0"), 2, 0.01);  // coordinates are rounded to tenths of some hundreds
  EXPECT_EQ(occurrences(svg, "class=\"whisker\""), 3U);
  EXPECT_TRUE(has(svg, ">2.00 [1.00, 3.00]</text>")) << svg;
  EXPECT_EQ(plot_note(plot), "Missing, and left out: c (1 of 1).");
}

TEST(Bars, StandInGroups) {
  const ReportPlot plot{.title = "t",
                        .kind = PlotKind::kBars,
                        .series = {{.name = "a", .values = {1, 2}}, {.name = "b", .values = {3}}},
                        .groups = {"dark", "tan"}};
  const std::string svg = svg_plot(plot, "p");
  EXPECT_EQ(occurrences(svg, "class=\"bar "), 3U);
  EXPECT_LT(svg.find(">dark</text>"), svg.find(">tan</text>"));
  EXPECT_EQ(occurrences(svg, ">b</text>"), 2U);  // its second place is empty
}

TEST(Lines, BreakWhereAValueIsMissing) {
  const ReportPlot plot{.title = "t",
                        .x_label = "x",
                        .y_label = "y",
                        .kind = PlotKind::kLines,
                        .series = {{.name = "a", .values = {1, 2, kNan, 4, 5}, .x = {0, 1, 2, 3, 4}}}};
  const std::string svg = svg_plot(plot, "p");
  const std::size_t at = svg.find(" d=\"", svg.find("class=\"curve s0\"")) + 4;
  const std::string path = svg.substr(at, svg.find('"', at) - at);
  EXPECT_EQ(occurrences(path, "M"), 2U) << path;
  EXPECT_EQ(occurrences(path, "L"), 2U) << path;
  EXPECT_EQ(plot_note(plot), "Missing, and left out: a (1 of 5).");
}

TEST(Plots, WithoutValuesSaySo) {
  for (const PlotKind kind : {PlotKind::kHistogram, PlotKind::kCumulative, PlotKind::kBars, PlotKind::kLines}) {
    EXPECT_EQ(svg_plot({.title = "t", .kind = kind}, "p"), "");
    EXPECT_EQ(plot_note({.title = "t", .kind = kind}), "There are no values to plot.");
    const ReportPlot failed{
        .title = "t", .kind = kind, .series = {{.name = "a", .values = {kNan}, .x = {1}}, {.name = "b"}}};
    EXPECT_EQ(svg_plot(failed, "p"), "");
    EXPECT_EQ(plot_note(failed), "There are no values to plot. Missing, and left out: a (1 of 1).");
    // One series may be empty, and one value is enough.
    const ReportPlot one{.title = "t", .kind = kind, .series = {{.name = "a", .values = {3}, .x = {1}}, {.name = "b"}}};
    EXPECT_TRUE(has(svg_plot(one, "p"), "<svg ")) << static_cast<int>(kind);
    EXPECT_EQ(plot_note(one), "");
  }
}

TEST(Plots, RefuseWhatDoesNotFit) {
  const ReportPlot lines{.title = "t", .kind = PlotKind::kLines, .series = {{.name = "a", .values = {1, 2}, .x = {1}}}};
  EXPECT_THROW(svg_plot(lines, "p"), std::invalid_argument);
  const ReportPlot bars{.title = "t", .kind = PlotKind::kBars, .series = {{.name = "a", .values = {1, 2}}}};
  EXPECT_THROW(svg_plot(bars, "p"), std::invalid_argument);
}

TEST(Plots, DescribeThemselvesAndEscapeNames) {
  const ReportPlot plot{.title = "a < b", .x_label = "x & y", .series = {{.name = "\"net\" <1>", .values = {1, 2}}}};
  const std::string svg = svg_plot(plot, "p");
  EXPECT_TRUE(has(svg, "<title id=\"p-title\">a &lt; b</title>")) << svg;
  EXPECT_TRUE(has(svg, "aria-labelledby=\"p-title p-desc\""));
  EXPECT_TRUE(
      has(svg, "<desc id=\"p-desc\">Histogram of x &amp; y. &quot;net&quot; &lt;1&gt;: n = 2, median 1.50.</desc>"))
      << svg;
  EXPECT_EQ(svg, svg_plot(plot, "p"));
}

TEST(Canvas, SeriesDifferInMoreThanColour) {
  std::set<std::string> looks;
  std::set<std::string> shapes;
  for (std::size_t i = 0; i < 12; ++i) {
    SvgCanvas canvas(100);
    canvas.path("M0 0", "curve", i, false);
    looks.insert(canvas.element(10, "p", "", ""));
    SvgCanvas marks(100);
    marks.marker(50, 50, i);
    shapes.insert(marks.element(10, "p", "", ""));
  }
  EXPECT_EQ(looks.size(), 12U);   // six colours, and the next six with other dashes
  EXPECT_EQ(shapes.size(), 12U);  // markers alike
}

TEST(Canvas, CutsLongTextsAtWholeCharacters) {
  SvgCanvas canvas(100);
  canvas.text(0, 0, "\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4\u00f6\u00fc\u00e4", "", Anchor::kStart,
              text_width("abcd"));
  EXPECT_TRUE(has(canvas.element(10, "p", "", ""), "</title>\u00e4\u00f6\u00fc\u2026</text>"));
}

TEST(Canvas, CoordinatesAreShortAndNeverMinusZero) {
  EXPECT_EQ(coordinate(12.04), "12");
  EXPECT_EQ(coordinate(12.06), "12.1");
  EXPECT_EQ(coordinate(-0.01), "0");
}

}  // namespace
}  // namespace faceprobe::eval
