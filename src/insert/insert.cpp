#include "faceprobe/insert/insert.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/insert/composite.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace faceprobe::insert {
namespace {

constexpr float kGroundReach = 3;      // radius of the ground, in the model's longest side
constexpr float kLeastAlbedo = 0.02F;  // of what an unknown ground is taken for
constexpr float kMostAlbedo = 0.8F;
constexpr int kBackdropPx = 1024;      // long side: what is seen through glass is bent anyway
constexpr std::uint64_t kGrainSeed = 1;

float longest_side(const render::Model& model) { return model.box().sizes().maxCoeff(); }

// The disc under the model's lowest point.
render::Ground ground_under(const Scene& scene) {
  const Eigen::Vector3f middle = scene.model.box().center();
  float lowest = std::numeric_limits<float>::infinity();
  for (const render::TriangleMesh& mesh : scene.model.meshes) lowest = std::min(lowest, (mesh.vertices * scene.up).minCoeff());
  render::Ground ground;
  ground.up = scene.up;
  ground.point = middle + (lowest - middle.dot(scene.up)) * scene.up;
  ground.radius_m = kGroundReach * longest_side(scene.model);
  return ground;
}

// The photo's colour over the light that falls there: what makes the ground look as it does. The photo is taken about the model's foot.
Eigen::Vector3f albedo_from_photo(const Image& photo, const Scene& scene, const render::Ground& ground) {
  const std::optional<PixelBox> near = box_in_view(scene.view, scene.model.box(), 0);
  if (!near) return Eigen::Vector3f::Constant(0.3F);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (int y = near->top + 3 * near->height() / 4; y < near->bottom; ++y) {
    for (int x = near->left; x < near->right; ++x, ++count) sum += Eigen::Map<const Eigen::Vector3f>(photo.pixel(x, y)).cast<double>();
  }
  const Eigen::Vector3f light = render::open_light(scene.environment, scene.lamps, ground.point, ground.up);
  const Eigen::Vector3f colour = (sum / std::max(1, count)).cast<float>();
  return (colour.array() / light.array().max(1e-6F)).min(kMostAlbedo).max(kLeastAlbedo);
}

render::PinholeView part_of(const render::PinholeView& view, const PixelBox& box) {
  return {view.focal_px, view.centre_x_px - box.left, view.centre_y_px - box.top, box.width(), box.height()};
}

render::Backdrop smaller(const Image& photo, const render::PinholeView& view, double scale) {
  const int width = std::max(1, static_cast<int>(std::lround(scale * photo.width())));
  const int height = std::max(1, static_cast<int>(std::lround(scale * photo.height())));
  return {{scale * view.focal_px, scale * view.centre_x_px, scale * view.centre_y_px, width, height},
          resampled(photo, {.scale = scale, .width = width, .height = height}, Outside::kEdge)};
}

render::Backdrop backdrop_of(const Image& photo, const render::PinholeView& view) {
  return smaller(photo, view, std::min(1.0, static_cast<double>(kBackdropPx) / std::max(photo.width(), photo.height())));
}

void soften(render::Layers& layers, float sigma_px) {
  layers.object = blur(layers.object, sigma_px);
  layers.shadow = blur(layers.shadow, sigma_px);
  layers.ground = blur(layers.ground, sigma_px);
}

// Grain where the thing is: the shadowed photo has its own.
void add_grain_in(Image& picture, const Insertion& done, const Hidden& hidden) {
  Image where(picture.width(), picture.height(), 1);
  for (int y = 0; y < done.box.height(); ++y) {
    for (int x = 0; x < done.box.width(); ++x) {
      const float shown = hidden.model.empty() ? 1 : 1 - hidden.model(x, y);
      where(done.box.left + x, done.box.top + y) = shown * done.layers.object(x, y, 3);
    }
  }
  add_grain(picture, where, done.grain, kGrainSeed);
}

}  // namespace

std::string Options::validate() const { return render.validate(); }

std::optional<PixelBox> box_in_view(const render::PinholeView& view, const Eigen::AlignedBox3f& box, float shadow_reach_m) {
  Eigen::AlignedBox3f reach = box;
  reach.min() -= Eigen::Vector3f(shadow_reach_m, 0, shadow_reach_m);
  reach.max() += Eigen::Vector3f(shadow_reach_m, 0, shadow_reach_m);
  constexpr float kNear = 0.01F;  // metres: what is nearer may be anywhere in the picture
  Eigen::AlignedBox2d seen;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f corner = reach.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
    const double depth = std::max(kNear, -corner.z());
    seen.extend(Eigen::Vector2d(view.centre_x_px + view.focal_px * static_cast<double>(corner.x()) / depth,
                                view.centre_y_px - view.focal_px * static_cast<double>(corner.y()) / depth));
  }
  if (box.min().z() >= -kNear) return std::nullopt;
  const auto inside = [](double value, int most) { return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most))); };
  const PixelBox out{inside(std::floor(seen.min().x()), view.width_px), inside(std::floor(seen.min().y()), view.height_px),
                     inside(std::ceil(seen.max().x()), view.width_px), inside(std::ceil(seen.max().y()), view.height_px)};
  if (out.width() <= 0 || out.height() <= 0) return std::nullopt;
  return out;
}

void shrink(Image& photo, Scene& scene, int long_side_px) {
  const int longer = std::max(photo.width(), photo.height());
  if (long_side_px <= 0 || longer <= long_side_px) return;
  const auto [view, small] = smaller(photo, scene.view, static_cast<double>(long_side_px) / longer);
  const auto scale = [&](const Image& image) {
    return resampled(image, {.scale = static_cast<double>(long_side_px) / longer, .width = view.width_px, .height = view.height_px}, Outside::kEdge);
  };
  if (scene.matte) scene.matte = Matte{scale(scene.matte->cover), scale(scene.matte->depth_m)};
  photo = small;
  scene.view = view;
}

Insertion insert_model(const Image& photo, const Scene& scene, const Options& options) {
  if (photo.width() != scene.view.width_px || photo.height() != scene.view.height_px || photo.channels() != 3)
    throw std::invalid_argument("The photo must have the size of the view and three channels.");
  for (const std::string& fault : {options.validate(), scene.model.validate()}) {
    if (!fault.empty()) throw std::invalid_argument(fault);
  }
  if (scene.matte && !(scene.matte->cover.same_size(photo) && scene.matte->depth_m.same_size(photo))) throw std::invalid_argument("The matte must have the photo's size.");
  if (!box_in_view(scene.view, scene.model.box(), 0))
    throw Error(ExitCode::kUsage, "No part of the object would be in the picture; place it elsewhere, or make it larger.");

  Insertion done;
  render::SceneOptions drawn;
  if (scene.ground) {
    drawn.ground = ground_under(scene);
    done.ground_albedo = scene.ground_albedo.value_or(albedo_from_photo(photo, scene, *drawn.ground));
    drawn.ground->albedo = done.ground_albedo;
  }
  done.box = *box_in_view(scene.view, scene.model.box(), scene.ground ? drawn.ground->radius_m : 0);
  drawn.view = part_of(scene.view, done.box);
  drawn.lamps = scene.lamps;
  drawn.backdrop = backdrop_of(photo, scene.view);
  const std::optional<render::Ground> ground = drawn.ground;
  const render::PinholeView part = drawn.view;
  render::RenderOptions render = options.render;
  if (render.progress)
    render.progress = [&](float share) { return !(done.stopped = !options.render.progress(share)); };
  done.layers = render::PathTracer(scene.model, scene.environment, std::move(drawn)).render(render);

  if (options.match_blur) done.blur_px = blur_to_match(estimate_blur_px(photo), kRenderedBlurPx);
  const Hidden hidden =
      scene.matte ? hidden_by(*scene.matte, done.layers, part, ground, done.box) : Hidden{};
  if (done.blur_px > 0) soften(done.layers, done.blur_px);
  done.picture = photo;
  composite(done.picture, done.box, done.layers, hidden);
  if (options.match_grain) {
    done.grain = estimate_grain(photo);
    add_grain_in(done.picture, done, hidden);
  }
  return done;
}

}  // namespace faceprobe::insert
