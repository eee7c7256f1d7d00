#pragma once
// Internal: an SVG element written piece by piece. Coordinates are rounded to a tenth of a unit, so that the same plot is the same text on every
// machine. Colours come from the page's style sheet by class (html.h): s0 .. s5 the series, "grid", "axis", "mark", "dim".
//
//   SvgCanvas canvas(640);
//   canvas.line(0, 0, 10, 10, "axis");
//   std::string svg = canvas.element(320, "plot-1", "Title", "What it shows");

#include <string>

namespace faceprobe::eval {

enum class Anchor { kStart, kMiddle, kEnd };

// Look of series number `index`: six colours that a reader who sees fewer can tell apart, with six dashes and six markers that go with them.
std::string series_class(std::size_t index);

class SvgCanvas {
 public:
  explicit SvgCanvas(double width) : width_(width) {}

  double width() const { return width_; }
  void line(double x1, double y1, double x2, double y2, const std::string& look);
  // `heavy`: the series is the one that a report is about.
  void path(const std::string& steps, const std::string& look, std::size_t series, bool heavy);
  void rect(double x, double y, double width, double height, const std::string& look);
  // The baseline is at y. `most` > 0: longer texts are cut, and whole in a tooltip.
  void text(double x, double y, const std::string& text, const std::string& look, Anchor anchor = Anchor::kStart,
            double most = 0);
  void upright_text(double x, double y, const std::string& text, const std::string& look);  // read from below, centred
  void marker(double x, double y, std::size_t series);
  // A short line with its marker, for legends.
  void swatch(double x, double y, std::size_t series, bool heavy);

  // All of it; `id` is unique in the page, `title` and `description` are for those who cannot see it.
  std::string element(double height, const std::string& id, const std::string& title,
                      const std::string& description) const;

 private:
  double width_;
  std::string body_;
};

// "12.3", "12": a coordinate.
std::string coordinate(double value);
// How wide a text is at the size of plots, about: fonts differ.
double text_width(const std::string& text);

}  // namespace faceprobe::eval
