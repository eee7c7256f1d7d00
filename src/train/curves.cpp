#include "train/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace faceprobe::train {
namespace {

constexpr int kWidth = kCurveWidth;
constexpr int kHeight = kCurveHeight;
constexpr int kLeft = 60, kRight = 16, kTop = 16, kBottom = 34;
using Colour = std::array<std::uint8_t, 3>;

// Three by five dots a character: digits, point, k.
constexpr std::array<std::array<std::uint8_t, 5>, 12> kGlyphs = {{{7, 5, 5, 5, 7},
                                                                  {2, 6, 2, 2, 7},
                                                                  {7, 1, 7, 4, 7},
                                                                  {7, 1, 7, 1, 7},
                                                                  {5, 5, 7, 1, 1},
                                                                  {7, 4, 7, 1, 7},
                                                                  {7, 4, 7, 5, 7},
                                                                  {7, 1, 1, 1, 1},
                                                                  {7, 5, 7, 5, 7},
                                                                  {7, 5, 7, 1, 7},
                                                                  {0, 0, 0, 0, 2},
                                                                  {4, 5, 6, 6, 5}}};

void dot(ByteImage& canvas, int x, int y, const Colour& colour) {
  if (x < 0 || y < 0 || x >= canvas.width() || y >= canvas.height()) return;
  for (int c = 0; c < 3; ++c) canvas(x, y, c) = colour[static_cast<std::size_t>(c)];
}

void write_number(ByteImage& canvas, const std::string& text, int x, int y) {
  constexpr int kDot = 2;
  for (const char letter : text) {
    const std::size_t glyph = letter >= '0' && letter <= '9' ? static_cast<std::size_t>(letter - '0')
                              : letter == '.'                ? 10U
                                                             : 11U;
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 3; ++column) {
        if ((kGlyphs[glyph][static_cast<std::size_t>(row)] >> (2 - column) & 1) == 0) continue;
        for (int k = 0; k < kDot * kDot; ++k)
          dot(canvas, x + kDot * column + k % kDot, y + kDot * row + k / kDot, {90, 90, 90});
      }
    }
    x += 4 * kDot;
  }
}

void line(ByteImage& canvas, double x0, double y0, double x1, double y1, const Colour& colour) {
  const int steps = static_cast<int>(std::max(std::abs(x1 - x0), std::abs(y1 - y0))) + 1;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const int x = static_cast<int>(std::lround(x0 + t * (x1 - x0)));
    const int y = static_cast<int>(std::lround(y0 + t * (y1 - y0)));
    dot(canvas, x, y, colour);
    dot(canvas, x, y + 1, colour);
  }
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

// Maps values to pixels: steps evenly, values by their logarithm.
struct Axes {
  double last_step, low, high;
  double x(double step) const { return kLeft + (kWidth - kLeft - kRight) * step / last_step; }
  double y(double value) const {
    const double t = std::log(std::max(low, value) / low) / std::log(high / low);
    return kHeight - kBottom - (kHeight - kTop - kBottom) * std::min(1.0, t);
  }
};

void draw_series(ByteImage& canvas, const Curve& curve, const Axes& axes) {
  const std::vector<CurvePoint>& points = curve.points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    line(canvas, axes.x(points[i - 1].step), axes.y(points[i - 1].value), axes.x(points[i].step),
         axes.y(points[i].value), curve.colour);
  }
}

// Grid lines at 1, 2 and 5 of each decade.
void draw_grid(ByteImage& canvas, const Axes& axes) {
  for (double decade = std::pow(10.0, std::floor(std::log10(axes.low))); decade <= axes.high; decade *= 10) {
    for (const double part : {1.0, 2.0, 5.0}) {
      const double value = part * decade;
      if (value < axes.low || value > axes.high) continue;
      line(canvas, kLeft, axes.y(value), kWidth - kRight, axes.y(value), {225, 225, 225});
      write_number(canvas, number(value), 6, static_cast<int>(axes.y(value)) - 5);
    }
  }
  for (int i = 0; i <= 4; ++i) {
    const double step = axes.last_step * i / 4;
    write_number(canvas, number(step / 1000) + "k", static_cast<int>(axes.x(step)) - (i == 4 ? 40 : 8), kHeight - 22);
  }
}

void frame(const std::vector<CurvePoint>& points, double& low, double& high) {
  for (const CurvePoint& p : points) {
    if (!(p.value > 0)) continue;
    low = std::min(low, p.value);
    high = std::max(high, p.value);
  }
}

}  // namespace

ByteImage draw_panels(const std::vector<CurvePanel>& panels, std::int64_t last_step) {
  ByteImage canvas(kWidth, static_cast<int>(panels.size()) * kHeight, 3, 255);
  ByteImage part(kWidth, kHeight, 3, 255);
  int top = 0;
  for (const CurvePanel& panel : panels) {
    std::ranges::fill(part.values(), std::uint8_t{255});
    double low = 1e30;
    double high = 0;
    for (const Curve& curve : panel) frame(curve.points, low, high);
    if (high > 0 && last_step > 0) {
      const Axes axes{static_cast<double>(last_step), 0.9 * low, 1.1 * high};
      draw_grid(part, axes);
      for (const Curve& curve : panel) draw_series(part, curve, axes);
    }
    std::ranges::copy(part.values(), canvas.pixel(0, top));
    top += kHeight;
  }
  return canvas;
}

}  // namespace faceprobe::train
