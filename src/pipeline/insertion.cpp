#include "faceprobe/pipeline/insertion.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/insert/spot.h"
#include "pipeline/insertion_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::pipeline {
namespace {

// Where a thing stands unless told: shares of the picture's size and of the face's depth.
constexpr double kSideMargin = 0.02;
constexpr double kBottom = 0.93;
constexpr double kSize = 0.35;       // of its longer side, of the picture's shorter one
constexpr float kFlatShare = 1e-4F;  // of a model's longest side: what is lower has no height to speak of
constexpr float kNearer = 0.75F;
constexpr double kFarPx = 1e6;  // beyond any picture, and within what floats bear
constexpr float kFarM = 100;    // beside somebody: further away it is beside nobody

float depth_of(const FaceEstimate& face) { return static_cast<float>(-face.face.position_m().z()); }

// What the faces' crops show of people: all that is not background.
insert::Matte matte_of(const Estimate& estimate, const Image& given) {
  insert::Matte matte{Image(estimate.photo_width, estimate.photo_height, 1),
                      Image(estimate.photo_width, estimate.photo_height, 1)};
  if (!given.empty()) {
    matte.cover = given;
    std::fill(matte.depth_m.values().begin(), matte.depth_m.values().end(), depth_of(estimate.largest_face()));
    return matte;
  }
  for (const FaceEstimate& face : estimate.faces) {
    const face::Crop& crop = face.geometry.crop;
    const Eigen::Vector2d low = crop.photo_from_crop(0, 0);
    const Eigen::Vector2d high = crop.photo_from_crop(crop.width, crop.height);
    const int right = std::min(estimate.photo_width, static_cast<int>(std::ceil(high.x())));
    const int bottom = std::min(estimate.photo_height, static_cast<int>(std::ceil(high.y())));
    for (int y = std::max(0, static_cast<int>(low.y())); y < bottom; ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x < right; ++x) {
        const Eigen::Vector2d at = crop.crop_from_photo(x + 0.5, y + 0.5);
        const int crop_x = std::clamp(static_cast<int>(at.x()), 0, crop.width - 1);
        const int crop_y = std::clamp(static_cast<int>(at.y()), 0, crop.height - 1);
        const auto region = static_cast<Region>(face.geometry.region(crop_x, crop_y));
        const float depth = depth_of(face);
        if (region == Region::kNone || (matte.cover(x, y) > 0 && matte.depth_m(x, y) < depth)) continue;
        matte.cover(x, y) = 1;
        matte.depth_m(x, y) = depth;
      }
    }
  }
  return matte;
}

}  // namespace

std::string InsertionOptions::validate() const {
  if (at_px && !(at_px->array().abs() <= kFarPx).all())
    return "The place in the photo must be two numbers of pixels, none above a million.";
  if (beside_m && !(std::abs(*beside_m) <= kFarM))
    return "The distance beside the face must be from -100 to 100 metres, found " + std::to_string(*beside_m) + ".";
  if (beside_m && at_px) return "The place is told twice, in pixels and beside the face; leave one of them out.";
  if (depth_m && !(*depth_m > 0.05F && *depth_m < 1000))
    return "The distance must be from .05 to 1000 metres, found " + std::to_string(*depth_m) + ".";
  if (height_m && !(*height_m > 1e-4F && *height_m < 1000))
    return "The height must be from .0001 to 1000 metres, found " + std::to_string(*height_m) + ".";
  if (!std::isfinite(turn_deg)) return "The turn must be a number of degrees.";
  if (horizon_px && !(std::abs(*horizon_px) <= kFarPx))
    return "The horizon must be a number of pixels, not above a million.";
  return {};
}

Image matte_from(const io::Photo& picture) {
  Image matte(picture.linear.width(), picture.linear.height(), 1);
  for (int y = 0; y < matte.height(); ++y) {
    for (int x = 0; x < matte.width(); ++x) matte(x, y) = srgb_from_linear(luminance(picture.linear.pixel(x, y)));
  }
  return matte;
}

render::PinholeView view_of(const Estimate& estimate) {
  const face::Camera& camera = estimate.camera;
  return {camera.focal_px, camera.centre_x_px, camera.centre_y_px, estimate.photo_width, estimate.photo_height};
}

Eigen::Vector3f up_in(const Estimate& estimate, const InsertionOptions& options) {
  if (options.horizon_px) return insert::up_from_horizon(view_of(estimate), *options.horizon_px);
  std::vector<Eigen::Vector3f> heads;
  for (const FaceEstimate& face : estimate.faces)
    heads.emplace_back(face.face.camera_from_face.linear().col(1).cast<float>());
  return insert::up_from_heads(heads);
}

Spot spot_for(const Estimate& estimate, const render::Model& model, const InsertionOptions& options) {
  const render::PinholeView view = view_of(estimate);
  const FaceEstimate& person =
      options.face ? estimate.faces.at(static_cast<std::size_t>(*options.face)) : estimate.largest_face();
  const float depth_unless_told = options.beside_m ? depth_of(person) : kNearer * depth_of(estimate.largest_face());
  const float depth_m = options.depth_m.value_or(depth_unless_told);
  const Eigen::Vector3f size = model.box().sizes();
  const double across_per_height = std::hypot(size.x(), size.z()) / std::max(1e-9F, size.y());
  const double px_per_m = view.focal_px / static_cast<double>(depth_m);
  const double room_px = kSize * std::min(view.width_px, view.height_px);
  const double height_m =
      options.height_m ? static_cast<double>(*options.height_m) : room_px / std::max(1.0, across_per_height) / px_per_m;
  // Its whole width in the picture, however it is turned; and its front, which is nearer than the foot, spreads from the middle.
  const double radius_px = 0.5 * across_per_height * height_m * px_per_m;
  const double front = 1 - std::min(0.5, radius_px / view.focal_px);
  const face::Box& box = estimate.largest_face().face.box;
  const bool more_room_right = box.x + 0.5F * box.width < 0.5F * static_cast<float>(view.width_px);
  const double edge_px = more_room_right ? (1 - kSideMargin) * view.width_px : kSideMargin * view.width_px;
  Eigen::Vector2d unless_told(
      view.centre_x_px + front * (edge_px - view.centre_x_px) + (more_room_right ? -radius_px : radius_px),
      view.centre_y_px + front * (kBottom * view.height_px - view.centre_y_px));
  if (options.beside_m)
    unless_told.x() =
        view.centre_x_px + (person.face.position_m().x() + static_cast<double>(*options.beside_m)) * px_per_m;
  return {options.at_px.value_or(unless_told), depth_m, static_cast<float>(height_m)};
}

insert::Scene scene_for(const io::Photo& photo, const Estimate& estimate, render::Model model,
                        const InsertionOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  if (!options.matte.empty() && !(options.matte.same_size(photo.linear) && options.matte.channels() == 1)) {
    throw Error(ExitCode::kUsage, "The matte must have the photo's size, " + std::to_string(photo.linear.width()) +
                                      " x " + std::to_string(photo.linear.height()) + ", found " +
                                      std::to_string(options.matte.width()) + " x " +
                                      std::to_string(options.matte.height()) + ".");
  }
  if (options.face && (*options.face < 0 || *options.face >= static_cast<int>(estimate.faces.size()))) {
    throw Error(ExitCode::kUsage, "The faces are numbered from 0 to " + std::to_string(estimate.faces.size() - 1) +
                                      ", left to right; found " + std::to_string(*options.face) + ".");
  }
  const Eigen::Vector3f size = model.box().sizes();
  if (!(size.y() > kFlatShare * size.maxCoeff()))
    throw Error(ExitCode::kInput,
                "The object is flat: it has no height to be placed by. Stand it upright, along +y, in its file.");
  insert::Scene scene;
  scene.view = view_of(estimate);
  scene.up = up_in(estimate, options);
  scene.ground = options.ground;
  scene.model = std::move(model);
  const Spot spot = spot_for(estimate, scene.model, options);
  const Eigen::Vector3f foot = insert::point_at(scene.view, spot.at_px.x(), spot.at_px.y(), spot.depth_m);
  render::place(
      scene.model,
      {.height_m = spot.height_m, .foot_m = foot, .up = scene.up, .turn = static_cast<float>(radians(options.turn_deg))});
  light_scene(estimate, foot, options, scene);
  scene.matte = matte_of(estimate, options.matte);
  return scene;
}

}  // namespace faceprobe::pipeline
