#include "faceprobe/lighting/surround.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

constexpr std::array<float, kSurroundRings + 1> kRadii = {1.2F, 1.6F, 2.2F, 3.2F};  // half heights of the face
constexpr int kStepsPerHalfHeight = 12;                                             // of the lattice that is looked at
constexpr float kWhite = 0.98F;

int sector_of(float right, float up) {
  const float radius = std::hypot(right, up);
  if (radius < kRadii.front() || radius >= kRadii.back()) return -1;
  int ring = 0;
  while (radius >= kRadii[static_cast<std::size_t>(ring) + 1]) ++ring;
  const float turns = std::atan2(up, right) / static_cast<float>(2 * kPi);
  const int angle = static_cast<int>(std::floor((turns < 0 ? turns + 1 : turns) * kSurroundAngles));
  return ring * kSurroundAngles + std::min(angle, kSurroundAngles - 1);
}

}  // namespace

Surround surround_of(const Image& linear, const Eigen::Vector2f& centre_px, float half_height_px) {
  if (linear.channels() != 3) throw std::invalid_argument("A surround needs a picture of three channels.");
  if (!(half_height_px > 0)) throw std::invalid_argument("A surround needs a face with a height.");
  constexpr int kReach = static_cast<int>(kRadii.back() * kStepsPerHalfHeight) + 1;
  constexpr float kStep = 1.0F / kStepsPerHalfHeight;
  Surround sums = Surround::Zero();
  Eigen::Array<float, kSurroundSectors, 1> points = Eigen::Array<float, kSurroundSectors, 1>::Zero();
  for (int row = -kReach; row < kReach; ++row) {
    for (int column = -kReach; column < kReach; ++column) {
      // Between the axes, so that the mirror image's lattice is the lattice's mirror image.
      const float right = kStep * (static_cast<float>(column) + 0.5F);
      const float up = kStep * (static_cast<float>(row) + 0.5F);
      const int sector = sector_of(right, up);
      if (sector < 0) continue;
      points[sector] += 1;
      const float x = std::floor(centre_px.x() + half_height_px * right);
      const float y = std::floor(centre_px.y() - half_height_px * up);
      if (!(x >= 0 && y >= 0 && x < static_cast<float>(linear.width()) && y < static_cast<float>(linear.height())))
        continue;
      const Eigen::Map<const Eigen::RowVector3f> seen(linear.pixel(static_cast<int>(x), static_cast<int>(y)));
      sums.row(sector).head<3>() += seen.cwiseMax(0.0F);
      if (seen.maxCoeff() >= kWhite) sums(sector, 3) += 1;
      sums(sector, 4) += 1;
    }
  }
  for (int sector = 0; sector < kSurroundSectors; ++sector) {
    const float seen = sums(sector, 4);
    if (!(seen > 0)) continue;
    sums.row(sector).head<4>() /= seen;
    sums(sector, 4) = seen / points[sector];
  }
  return sums;
}

Surround mirrored(const Surround& surround) {
  Surround out;
  for (int ring = 0; ring < kSurroundRings; ++ring) {
    for (int k = 0; k < kSurroundAngles; ++k) {
      const int from = (kSurroundAngles / 2 - 1 - k + kSurroundAngles) % kSurroundAngles;
      out.row(ring * kSurroundAngles + k) = surround.row(ring * kSurroundAngles + from);
    }
  }
  return out;
}

}  // namespace faceprobe::lighting
