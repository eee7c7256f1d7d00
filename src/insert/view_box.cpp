#include "faceprobe/insert/spot.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::insert {

std::optional<PixelBox> box_in_view(const render::PinholeView& view, const Eigen::AlignedBox3f& box) {
  constexpr float kNear = 0.01F;  // metres: what is nearer may be anywhere in the picture
  Eigen::AlignedBox2d seen;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
    const double depth = std::max(kNear, -corner.z());
    seen.extend(Eigen::Vector2d(view.centre_x_px + view.focal_px * static_cast<double>(corner.x()) / depth,
                                view.centre_y_px - view.focal_px * static_cast<double>(corner.y()) / depth));
  }
  if (box.min().z() >= -kNear) return std::nullopt;
  const auto inside = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const PixelBox out{
      inside(std::floor(seen.min().x()), view.width_px), inside(std::floor(seen.min().y()), view.height_px),
      inside(std::ceil(seen.max().x()), view.width_px), inside(std::ceil(seen.max().y()), view.height_px)};
  if (out.width() <= 0 || out.height() <= 0) return std::nullopt;
  return out;
}

}  // namespace faceprobe::insert
