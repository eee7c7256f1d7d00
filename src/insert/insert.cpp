#include "faceprobe/insert/insert.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/insert/composite.h"
#include "faceprobe/insert/spot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace faceprobe::insert {
namespace {

constexpr float kGroundReach = 3;      // radius of the ground, in the model's longest side
constexpr float kBlurReach = 3;        // of a Gaussian, in its deviations
constexpr float kLeastAlbedo = 0.02F;  // of what an unknown ground is taken for
constexpr float kMostAlbedo = 0.8F;
constexpr int kBackdropPx = 1024;  // long side: what is seen through glass is bent anyway
constexpr std::uint64_t kGrainSeed = 1;

Eigen::AlignedBox3f with_ground(Eigen::AlignedBox3f box, const render::Ground& ground) {
  // A disc's half width along each axis.
  const Eigen::Vector3f half = ground.radius_m * (1 - ground.up.array().square()).max(0.0F).sqrt().matrix();
  return box.extend(ground.point_m - half).extend(ground.point_m + half);
}

PixelBox wider(const PixelBox& box, int margin_px, const render::PinholeView& view) {
  return {std::max(0, box.left - margin_px), std::max(0, box.top - margin_px),
          std::min(view.width_px, box.right + margin_px), std::min(view.height_px, box.bottom + margin_px)};
}

float longest_side(const render::Model& model) { return model.box().sizes().maxCoeff(); }

// The disc under the model's lowest point.
render::Ground ground_under(const Scene& scene) {
  const Eigen::Vector3f middle = scene.model.box().center();
  float lowest = std::numeric_limits<float>::infinity();
  for (const render::TriangleMesh& mesh : scene.model.meshes)
    lowest = std::min(lowest, (mesh.vertices * scene.up).minCoeff());
  render::Ground ground;
  ground.up = scene.up;
  ground.point_m = middle + (lowest - middle.dot(scene.up)) * scene.up;
  ground.radius_m = kGroundReach * longest_side(scene.model);
  return ground;
}

// The photo's colour over the light that falls there: what makes the ground look as it does. The photo is taken about the model's foot; `box`:
// where the model is seen.
Eigen::Vector3f albedo_from_photo(const Image& photo, const PixelBox& box, const Scene& scene,
                                  const render::Ground& ground) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (int y = box.top + 3 * box.height() / 4; y < box.bottom; ++y) {
    for (int x = box.left; x < box.right; ++x, ++count)
      sum += Eigen::Map<const Eigen::Vector3f>(photo.pixel(x, y)).cast<double>();
  }
  const Eigen::Vector3f light = render::open_light(scene.environment, scene.lamps, ground.point_m, ground.up);
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

// Shadows as darkness of the ground, 1 - shadow where it is seen: blurred apart they would be torn from the thing's foot.
void soften_shadow(render::Layers& layers, float sigma_px) {
  Image darkness = layers.shadow;
  for (std::size_t i = 0; i < darkness.values().size(); ++i)
    darkness.data()[i] = layers.ground.data()[i / 3] * (1 - darkness.data()[i]);
  darkness = blur(darkness, sigma_px);
  layers.ground = blur(layers.ground, sigma_px);
  for (std::size_t i = 0; i < darkness.values().size(); ++i) {
    const float ground = layers.ground.data()[i / 3];
    layers.shadow.data()[i] = ground > 1e-6F ? 1 - darkness.data()[i] / ground : 1;
  }
}

void soften(render::Layers& layers, float sigma_px) {
  soften_shadow(layers, sigma_px);
  // Depth goes where coverage goes, as its mean.
  Image depth = layers.depth;
  for (std::size_t i = 0; i < depth.values().size(); ++i) depth.data()[i] *= layers.object.data()[4 * i + 3];
  depth = blur(depth, sigma_px);
  layers.object = blur(layers.object, sigma_px);
  for (std::size_t i = 0; i < depth.values().size(); ++i) {
    const float cover = layers.object.data()[4 * i + 3];
    layers.depth.data()[i] = cover > 1e-6F ? depth.data()[i] / cover : 0;
  }
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

void shrink(Image& photo, Scene& scene, int long_side_px) {
  const int longer = std::max(photo.width(), photo.height());
  if (long_side_px <= 0 || longer <= long_side_px) return;
  const auto [view, small] = smaller(photo, scene.view, static_cast<double>(long_side_px) / longer);
  const Window window{
      .scale = static_cast<double>(long_side_px) / longer, .width = view.width_px, .height = view.height_px};
  if (scene.matte)
    scene.matte = Matte{resampled(scene.matte->cover, window, Outside::kEdge), nearest(scene.matte->depth_m, window)};
  photo = small;
  scene.view = view;
}

Insertion insert_model(const Image& photo, const Scene& scene, const Options& options) {
  if (photo.width() != scene.view.width_px || photo.height() != scene.view.height_px || photo.channels() != 3)
    throw std::invalid_argument("The photo must have the size of the view and three channels.");
  for (const std::string& fault : {options.validate(), scene.model.validate()}) {
    if (!fault.empty()) throw std::invalid_argument(fault);
  }
  if (scene.matte && !(scene.matte->cover.same_size(photo) && scene.matte->depth_m.same_size(photo)))
    throw std::invalid_argument("The matte must have the photo's size.");
  const std::optional<PixelBox> model_box = box_in_view(scene.view, scene.model.box());
  if (!model_box)
    throw Error(ExitCode::kUsage,
                "No part of the object would be in the picture; place it elsewhere, or make it larger.");

  Insertion done;
  render::SceneOptions drawn;
  if (scene.ground) {
    drawn.ground = ground_under(scene);
    done.ground_albedo =
        scene.ground_albedo ? *scene.ground_albedo : albedo_from_photo(photo, *model_box, scene, *drawn.ground);
    drawn.ground->albedo = done.ground_albedo;
  }
  if (options.match_blur) done.blur_px = blur_to_match(estimate_blur_px(photo), kRenderedBlurPx);
  done.box = scene.ground ? *box_in_view(scene.view, with_ground(scene.model.box(), *drawn.ground)) : *model_box;
  done.box = wider(done.box, static_cast<int>(std::ceil(kBlurReach * done.blur_px)), scene.view);
  drawn.view = part_of(scene.view, done.box);
  drawn.lamps = scene.lamps;
  drawn.backdrop = backdrop_of(photo, scene.view);
  const std::optional<render::Ground> ground = drawn.ground;
  const render::PinholeView part = drawn.view;
  render::RenderOptions render = options.render;
  if (render.progress)
    render.progress = [&](float share) {
      if (!options.render.progress(share)) done.stopped = true;
      return !done.stopped;
    };
  done.layers = render::PathTracer(scene.model, scene.environment, std::move(drawn)).render(render);

  if (done.blur_px > 0) soften(done.layers, done.blur_px);
  const Hidden hidden = scene.matte ? hidden_by(*scene.matte, done.layers, part, ground, done.box) : Hidden{};
  done.picture = photo;
  composite(done.picture, done.box, done.layers, hidden);
  if (options.match_grain) {
    done.grain = estimate_grain(photo);
    add_grain_in(done.picture, done, hidden);
  }
  return done;
}

}  // namespace faceprobe::insert
