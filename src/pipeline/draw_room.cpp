#include "faceprobe/core/angles.h"
#include "faceprobe/io/text.h"
#include "faceprobe/pipeline/room.h"
#include "pipeline/canvas.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace faceprobe::pipeline {
namespace {

constexpr Colour kRayColour = {90, 94, 102};
constexpr Colour kFaceColour = {90, 220, 255};
constexpr std::array<Colour, 5> kLampColours = {
    {{255, 200, 60}, {255, 92, 80}, {110, 225, 120}, {110, 170, 255}, {225, 130, 255}}};
constexpr int kViewPx = 640;
constexpr int kFrameMargin = 48;
constexpr double kRayMetres = 1.2;
constexpr int kTitlePx = 17, kLabelPx = 15;
constexpr double kLetterWidth = 0.63;  // of the font's height, at most on average

// A view along an axis: two coordinates of the room across and up the picture.
struct View {
  int across, up;
  double across_sign, up_sign;
  const char* title;
  int left_px;

  Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {across_sign * p[across], up_sign * p[up]}; }
};

struct Frame {
  Eigen::Vector2d low{0, 0}, high{0, 0};  // the camera is at the origin
  void add(const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double scale() const { return (kViewPx - 2 * kFrameMargin) / std::max(0.5, (high - low).maxCoeff()); }
  Eigen::Vector2d pixel(const Eigen::Vector2d& p, int left_px) const {
    const Eigen::Vector2d middle = 0.5 * (low + high);
    return {left_px + 0.5 * kViewPx + scale() * (p.x() - middle.x()), 0.5 * kViewPx - scale() * (p.y() - middle.y())};
  }
};

// One standard deviation as the view shows it.
void draw_ellipse(ByteImage& canvas, const View& view, const Frame& frame, const lighting::Lamp& lamp,
                  const Colour& colour) {
  Eigen::Matrix<double, 2, 3> flat = Eigen::Matrix<double, 2, 3>::Zero();
  flat(0, view.across) = view.across_sign;
  flat(1, view.up) = view.up_sign;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(flat * lamp.covariance_m2 * flat.transpose());
  constexpr int kPieces = 48;
  Eigen::Vector2d last;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = 2 * kPi * i / kPieces;
    const Eigen::Vector2d on_axes =
        axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().cwiseProduct(Eigen::Vector2d(std::cos(t), std::sin(t)));
    const Eigen::Vector2d at = frame.pixel(view.flat(lamp.position_m) + axes.eigenvectors() * on_axes, view.left_px);
    if (i > 0) draw_line(canvas, last, at, colour, 0.8F);
    last = at;
  }
}

void draw_view(ByteImage& canvas, const View& view, const Room& room) {
  Frame frame;
  for (const lighting::FaceLights& face : room.faces) frame.add(view.flat(face.position_m));
  for (const lighting::Lamp& lamp : room.lamps) {
    if (lamp.near) frame.add(view.flat(lamp.position_m));
  }
  const auto pixel = [&](const Eigen::Vector3d& p) { return frame.pixel(view.flat(p), view.left_px); };
  const auto label = [&](const Eigen::Vector3d& p, const std::string& words, const Colour& colour) {
    const Eigen::Vector2d at = pixel(p);
    const int width = static_cast<int>(kLetterWidth * kLabelPx * static_cast<double>(words.size()));
    const int last = view.left_px + kViewPx - 4 - width;  // further right it would be cut off
    io::draw_text(canvas, std::min(static_cast<int>(at.x()) + 10, last), static_cast<int>(at.y()) - 8, words, kLabelPx,
                  colour, false);
  };
  io::draw_text(canvas, view.left_px + 16, 12 + kTitlePx, view.title, kTitlePx, kInk, true);
  draw_ring(canvas, pixel(Eigen::Vector3d::Zero()), 5, kInk);
  label(Eigen::Vector3d::Zero(), "camera", kInk);
  for (std::size_t f = 0; f < room.faces.size(); ++f) {
    const lighting::FaceLights& face = room.faces[f];
    for (const lighting::MainLight& light : face.lights)
      draw_line(canvas, pixel(face.position_m), pixel(face.position_m + kRayMetres * light.direction), kRayColour, 0.8F);
    draw_ring(canvas, pixel(face.position_m), std::max(4.0, 0.1 * frame.scale()), kFaceColour);
    label(face.position_m, "face " + std::to_string(f + 1), kFaceColour);
  }
  for (std::size_t i = 0; i < room.lamps.size(); ++i) {
    const lighting::Lamp& lamp = room.lamps[i];
    const Colour& colour = kLampColours[i % kLampColours.size()];
    for (const lighting::Sighting& s : lamp.seen) {
      const Eigen::Vector3d& from = room.faces[static_cast<std::size_t>(s.face)].position_m;
      const Eigen::Vector3d to = lamp.near ? lamp.position_m : Eigen::Vector3d(from + kRayMetres * lamp.direction);
      draw_line(canvas, pixel(from), pixel(to), colour, 0.7F);
    }
    if (!lamp.near) continue;
    draw_ring(canvas, pixel(lamp.position_m), 6, colour);
    draw_ellipse(canvas, view, frame, lamp, colour);
    label(lamp.position_m, "lamp " + std::to_string(i + 1), colour);
  }
  // A metre, to measure by.
  const Eigen::Vector2d start(view.left_px + 16, kViewPx - 20);
  draw_line(canvas, start, start + Eigen::Vector2d(frame.scale(), 0), kInk);
  io::draw_text(canvas, view.left_px + 16, kViewPx - 44, "1 m", kLabelPx, kInk, false);
}

}  // namespace

ByteImage draw_room(const Room& room) {
  ByteImage canvas(2 * kViewPx, kViewPx, 3);
  fill(canvas, 0, 0, 2 * kViewPx, kViewPx, kPaper);
  // Away from the camera is up when seen from above, and to the right when seen from the side.
  draw_view(canvas, {0, 2, 1, -1, "from above", 0}, room);
  draw_view(canvas, {2, 1, -1, 1, "from the right", kViewPx}, room);
  return canvas;
}

}  // namespace faceprobe::pipeline
