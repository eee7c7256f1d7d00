#include "faceprobe/lighting/horizon.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/smooth_step.h"
#include "lighting/horizon_profile.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {

namespace {

// Steps start far enough out that a patch is not shadowed by the roundness of its own neighbourhood.
constexpr double kFirstStep = 3.0;
constexpr double kStepGrowth = 1.15;
constexpr float kSoftEdgeRad = 0.035F;  // half of 4 degrees

}  // namespace

Eigen::MatrixXf horizon_tangents(const Image& position_cam_m, const Eigen::MatrixX2i& pixels, int threads) {
  if (position_cam_m.channels() != 3) throw std::invalid_argument("Horizons need a three-channel position picture.");
  Eigen::MatrixXf tangents = Eigen::MatrixXf::Constant(pixels.rows(), kHorizonAzimuths, kNothingBlocks);
  const double reach = std::hypot(position_cam_m.width(), position_cam_m.height());
  parallel_for(static_cast<int>(pixels.rows()), threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Eigen::Map<const Eigen::Vector3f> here(position_cam_m.pixel(pixels(i, 0), pixels(i, 1)));
      for (int a = 0; a < kHorizonAzimuths; ++a) {
        const double azimuth = 2.0 * kPi * a / kHorizonAzimuths;
        const double dx = std::cos(azimuth);
        const double dy = -std::sin(azimuth);  // picture rows grow downwards
        float& highest = tangents(i, a);
        for (double step = kFirstStep; step < reach; step *= kStepGrowth) {
          const int x = static_cast<int>(std::lround(pixels(i, 0) + step * dx));
          const int y = static_cast<int>(std::lround(pixels(i, 1) + step * dy));
          if (x < 0 || y < 0 || x >= position_cam_m.width() || y >= position_cam_m.height()) break;
          const Eigen::Map<const Eigen::Vector3f> there(position_cam_m.pixel(x, y));
          if (there.isZero()) continue;
          const float run = std::hypot(there.x() - here.x(), there.y() - here.y());
          if (run > 0.0F) highest = std::max(highest, (there.z() - here.z()) / run);
        }
      }
    }
  });
  return tangents;
}

HorizonPlace horizon_place(const Eigen::Vector3f& direction) {
  double turn = std::atan2(static_cast<double>(direction.y()), static_cast<double>(direction.x())) / (2.0 * kPi);
  if (turn < 0) turn += 1.0;
  const double position = turn * kHorizonAzimuths;
  HorizonPlace place;
  place.before = static_cast<int>(position) % kHorizonAzimuths;
  place.after = (place.before + 1) % kHorizonAzimuths;
  place.fraction = static_cast<float>(position - std::floor(position));
  place.elevation = std::atan2(direction.z(), std::hypot(direction.x(), direction.y()));
  return place;
}

std::vector<HorizonPlace> horizon_places(const Eigen::MatrixX3f& directions) {
  std::vector<HorizonPlace> places;
  places.reserve(static_cast<std::size_t>(directions.rows()));
  for (Eigen::Index j = 0; j < directions.rows(); ++j) places.push_back(horizon_place(directions.row(j).transpose()));
  return places;
}

HorizonProfile horizon_profile(const Eigen::Ref<const Eigen::RowVectorXf>& tangents) {
  HorizonProfile profile{};
  for (int a = 0; a < kHorizonAzimuths; ++a) profile[static_cast<std::size_t>(a)] = std::atan(tangents[a]);
  return profile;
}

float profile_visibility(const HorizonProfile& profile, const HorizonPlace& place) {
  const float horizon = (1.0F - place.fraction) * profile[static_cast<std::size_t>(place.before)] +
                        place.fraction * profile[static_cast<std::size_t>(place.after)];
  return smooth_step(0.0F, 1.0F, (place.elevation - horizon) / (2.0F * kSoftEdgeRad) + 0.5F);
}

float horizon_visibility(const Eigen::Ref<const Eigen::RowVectorXf>& tangents, const Eigen::Vector3f& direction) {
  return profile_visibility(horizon_profile(tangents), horizon_place(direction));
}

}  // namespace faceprobe::lighting
