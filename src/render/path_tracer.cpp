#include "faceprobe/render/path_tracer.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/parallel.h"
#include "render/light_set.h"
#include "render/path.h"
#include "render/ray_scene.h"
#include "render/tile.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace faceprobe::render {
namespace {

constexpr int kMaxSide = 16384;

void refuse(const std::string& fault) {
  if (!fault.empty()) throw std::invalid_argument(fault);
}

Layers empty_layers(const PinholeView& view) {
  const int w = view.width_px;
  const int h = view.height_px;
  return {Image(w, h, 4), Image(w, h, 3, 1.0F), Image(w, h, 1), Image(w, h, 1), Image(w, h, 3), Image(w, h, 1)};
}

}  // namespace

std::string SceneOptions::validate() const {
  if (view.width_px < 1 || view.height_px < 1 || view.width_px > kMaxSide || view.height_px > kMaxSide)
    return "A view must be from 1 to " + std::to_string(kMaxSide) + " pixels wide and high, found " +
           std::to_string(view.width_px) + " x " + std::to_string(view.height_px) + ".";
  if (!(view.focal_px > 0) || !std::isfinite(view.focal_px) || !std::isfinite(view.centre_x_px) ||
      !std::isfinite(view.centre_y_px))
    return "A view needs a focal length above 0 pixels and a finite centre.";
  if (ground) {
    if (!ground->point_m.allFinite() || std::abs(ground->up.norm() - 1) > 1e-3F)
      return "A ground needs a finite place and a unit normal.";
    if (!(ground->radius_m > 0) || !std::isfinite(ground->radius_m)) return "A ground needs a radius above 0 metres.";
    if (!(ground->albedo.minCoeff() >= 0 && ground->albedo.maxCoeff() <= 1))
      return "A ground's albedo must be from 0 to 1.";
  }
  for (const BallLamp& lamp : lamps) {
    if (!lamp.position_m.allFinite() || !lamp.intensity.allFinite() || lamp.intensity.minCoeff() < 0)
      return "A lamp needs a finite place and an intensity of 0 or more.";
    if (!(lamp.radius_m > 0) || !std::isfinite(lamp.radius_m)) return "A lamp needs a radius above 0 metres.";
  }
  if (backdrop &&
      (backdrop->picture.width() != backdrop->view.width_px || backdrop->picture.height() != backdrop->view.height_px ||
       backdrop->picture.channels() != 3 || !(backdrop->view.focal_px > 0) || !std::isfinite(backdrop->view.focal_px) ||
       !std::isfinite(backdrop->view.centre_x_px) || !std::isfinite(backdrop->view.centre_y_px)))
    return "A backdrop must have the size of its view, a focal length and three channels.";
  return {};
}

std::string RenderOptions::validate() const {
  if (samples < 1 || samples > 1 << 20)
    return "samples must be from 1 to 1048576, found " + std::to_string(samples) + ".";
  if (least_samples < 1) return "least_samples must be 1 or more, found " + std::to_string(least_samples) + ".";
  if (!(noise >= 0) || !(noise <= 1)) return "noise must be from 0 to 1, found " + std::to_string(noise) + ".";
  if (max_bounces < 1 || max_bounces > 1000)
    return "max_bounces must be from 1 to 1000, found " + std::to_string(max_bounces) + ".";
  if (!(clamp_indirect >= 0)) return "clamp_indirect must be 0 or more, found " + std::to_string(clamp_indirect) + ".";
  return {};
}

struct PathTracer::State {
  State(Model model, const EnvMap& environment, SceneOptions wanted)
      : options(std::move(wanted)), lights(environment, options.lamps, model.box().center()),
        rays(std::move(model), options.ground) {}

  SceneOptions options;
  LightSet lights;
  RayScene rays;
};

PathTracer::PathTracer(Model model, const EnvMap& environment, SceneOptions options) {
  refuse(options.validate());
  refuse(model.validate());
  if (environment.width() == 0) throw std::invalid_argument("A scene needs an environment map.");
  for (const float value : environment.radiance().values()) {
    if (!(value >= 0) || !std::isfinite(value))
      throw std::invalid_argument("An environment map must be finite and not negative.");
  }
  state_ = std::make_unique<State>(std::move(model), environment, std::move(options));
}

PathTracer::~PathTracer() = default;
PathTracer::PathTracer(PathTracer&&) noexcept = default;
PathTracer& PathTracer::operator=(PathTracer&&) noexcept = default;

Layers PathTracer::render(const RenderOptions& options) const {
  refuse(options.validate());
  const PinholeView& view = state_->options.view;
  Layers out = empty_layers(view);
  const PathScene scene{state_->rays, state_->lights, state_->options, options.max_bounces, options.clamp_indirect};
  const int columns = (view.width_px + kTilePx - 1) / kTilePx;
  const int tiles = columns * ((view.height_px + kTilePx - 1) / kTilePx);
  std::atomic<int> next{0};
  int done = 0;
  std::atomic<bool> stop{false};
  std::mutex reporting;
  const int threads = std::min(tiles, options.threads > 0 ? options.threads : default_thread_count());
  parallel_for(threads, threads, [&](int, int) {
    for (int tile = next++; tile < tiles && !stop; tile = next++) {
      render_tile(scene, options, tile % columns, tile / columns, out);
      if (!options.progress) continue;
      const std::lock_guard lock(reporting);
      if (stop) break;
      stop = true;  // should the callback throw, the others need not go on
      stop = !options.progress(static_cast<float>(++done) / static_cast<float>(tiles));
    }
  });
  return out;
}

Eigen::Vector3f open_light(const EnvMap& environment, const std::vector<BallLamp>& lamps, const Eigen::Vector3f& point,
                           const Eigen::Vector3f& normal) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < environment.height(); ++y) {
    const double solid_angle = texel_solid_angle(y, environment.width(), environment.height());
    for (int x = 0; x < environment.width(); ++x) {
      const float cosine = normal.dot(environment.direction(x, y));
      if (cosine > 0)
        sum +=
            cosine * solid_angle * Eigen::Map<const Eigen::Vector3f>(environment.radiance().pixel(x, y)).cast<double>();
    }
  }
  for (const BallLamp& lamp : lamps) {
    const Eigen::Vector3f way = lamp.position_m - point;
    const float distance = way.norm();
    if (distance <= lamp.radius_m) continue;
    sum += (std::max(0.0F, normal.dot(way)) / (distance * distance * distance) * lamp.intensity).cast<double>();
  }
  return (sum / kPi).cast<float>();
}

}  // namespace faceprobe::render
