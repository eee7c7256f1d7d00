#include "eval/report/svg_canvas.h"

#include "eval/markdown.h"
#include "eval/report/html.h"

#include <array>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr std::size_t kLooks = 6;
constexpr std::array<const char*, kLooks> kDashes = {"", "8 3", "2 3", "10 3 2 3", "5 2", "12 3 2 3 2 3"};
constexpr double kCharacter = 7.7;  // mean width at 13 px, of the wider sans-serif fonts

// Series beyond the sixth have a colour again, with another dash.
std::size_t dash_of(std::size_t series) { return (series + series / kLooks) % kLooks; }

std::size_t characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;  // not the middle of one
  return count;
}

// The first `count` characters.
std::string beginning(const std::string& text, std::size_t count) {
  std::size_t end = 0;
  while (end < text.size()) {
    if ((static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U && count-- == 0) break;
    ++end;
  }
  return text.substr(0, end);
}

std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + coordinate(value) + '"';
}

std::string point(double x, double y) { return coordinate(x) + ' ' + coordinate(y); }

}  // namespace

std::string coordinate(double value) {
  std::string text = rounded(value, 1);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

double text_width(const std::string& text) { return kCharacter * static_cast<double>(characters(text)); }

std::string series_class(std::size_t index) { return "s" + std::to_string(index % kLooks); }

void SvgCanvas::line(double x1, double y1, double x2, double y2, const std::string& look) {
  body_ += "<line class=\"" + look + '"' + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
           attribute("y2", y2) + "/>\n";
}

void SvgCanvas::path(const std::string& steps, const std::string& look, std::size_t series, bool heavy) {
  const std::string dash = kDashes[dash_of(series)];
  body_ += "<path class=\"" + look + ' ' + series_class(series) + (heavy ? " heavy" : "") + '"' +
           (dash.empty() ? "" : " stroke-dasharray=\"" + dash + '"') + " d=\"" + steps + "\"/>\n";
}

void SvgCanvas::rect(double x, double y, double width, double height, const std::string& look) {
  body_ += "<rect class=\"" + look + '"' + attribute("x", x) + attribute("y", y) + attribute("width", width) +
           attribute("height", height) + "/>\n";
}

void SvgCanvas::text(double x, double y, const std::string& text, const std::string& look, Anchor anchor, double most) {
  static constexpr std::array<const char*, 3> kAnchors = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
  body_ += "<text" + (look.empty() ? std::string() : " class=\"" + look + '"') + attribute("x", x) + attribute("y", y) +
           kAnchors[static_cast<std::size_t>(anchor)] + '>';
  const auto fits = static_cast<std::size_t>(std::max(2.0, most / kCharacter));
  if (most > 0 && characters(text) > fits) {
    body_ += "<title>" + escaped_html(text) + "</title>" + escaped_html(beginning(text, fits - 1)) + "\u2026";
  } else {
    body_ += escaped_html(text);
  }
  body_ += "</text>\n";
}

void SvgCanvas::upright_text(double x, double y, const std::string& text, const std::string& look) {
  body_ += "<text class=\"" + look + "\" text-anchor=\"middle\" transform=\"translate(" + point(x, y) +
           ") rotate(-90)\">" + escaped_html(text) + "</text>\n";
}

void SvgCanvas::marker(double x, double y, std::size_t series) {
  constexpr double r = 4;
  const std::string look = "<path class=\"marker " + series_class(series) + "\" d=\"";
  switch (dash_of(series)) {
    case 0:
      body_ += "<circle class=\"marker " + series_class(series) + '"' + attribute("cx", x) + attribute("cy", y) +
               attribute("r", r) + "/>\n";
      return;
    case 1:  // square
      body_ += look + 'M' + point(x - r, y - r) + 'H' + coordinate(x + r) + 'V' + coordinate(y + r) + 'H' +
               coordinate(x - r) + "Z\"/>\n";
      return;
    case 2:  // triangle
      body_ += look + 'M' + point(x, y - r - 1) + 'L' + point(x + r + 0.5, y + r) + 'H' + coordinate(x - r - 0.5) +
               "Z\"/>\n";
      return;
    case 3:  // diamond
      body_ += look + 'M' + point(x, y - r - 1) + 'L' + point(x + r + 1, y) + 'L' + point(x, y + r + 1) + 'L' +
               point(x - r - 1, y) + "Z\"/>\n";
      return;
    case 4:  // triangle on its tip
      body_ += look + 'M' + point(x, y + r + 1) + 'L' + point(x + r + 0.5, y - r) + 'H' + coordinate(x - r - 0.5) +
               "Z\"/>\n";
      return;
    default:  // cross
      body_ += look + 'M' + point(x - r, y - r) + 'L' + point(x + r, y + r) + 'M' + point(x - r, y + r) + 'L' +
               point(x + r, y - r) + "\"/>\n";
  }
}

void SvgCanvas::swatch(double x, double y, std::size_t series, bool heavy) {
  path('M' + point(x, y) + 'H' + coordinate(x + 40), "curve", series, heavy);
  marker(x + 20, y, series);
}

std::string SvgCanvas::element(double height, const std::string& id, const std::string& title,
                               const std::string& description) const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-labelledby=\"" + id + "-title " + id +
         "-desc\" viewBox=\"0 0 " + coordinate(width_) + ' ' + coordinate(height) + "\">\n<title id=\"" + id +
         "-title\">" + escaped_html(title) + "</title>\n<desc id=\"" + id + "-desc\">" + escaped_html(description) +
         "</desc>\n" + body_ + "</svg>\n";
}

}  // namespace faceprobe::eval
