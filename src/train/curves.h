#pragma once
// Internal: curves over the steps of a run, as a picture.
//
//   const ByteImage picture = draw_panels({{{.points = {{50, 0.3}, {100, 0.2}}, .colour = kCurveBlack}}}, 100);

#include "faceprobe/core/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace faceprobe::train {

inline constexpr int kCurveWidth = 960;   // of a panel
inline constexpr int kCurveHeight = 420;  // the same
inline constexpr std::array<std::uint8_t, 3> kCurveBlack = {30, 30, 30};
inline constexpr std::array<std::uint8_t, 3> kCurveBlue = {40, 80, 200};
inline constexpr std::array<std::uint8_t, 3> kCurveRed = {200, 50, 40};

struct CurvePoint {
  double step, value;
};

struct Curve {
  std::vector<CurvePoint> points;
  std::array<std::uint8_t, 3> colour = kCurveBlack;
};

// One scale, logarithmic, for all curves of a panel; what is not above 0 lies at its bottom.
using CurvePanel = std::vector<Curve>;

// Below one another, each kCurveWidth x kCurveHeight x 3, sRGB. A panel without anything above 0 is white.
ByteImage draw_panels(const std::vector<CurvePanel>& panels, std::int64_t last_step);

}  // namespace faceprobe::train
