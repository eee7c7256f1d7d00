#include "faceprobe/insert/composite.h"

#include <algorithm>

namespace faceprobe::insert {
namespace {

// Depth along -z where the ray through a pixel's centre meets the ground's plane; 0 where it does not.
float ground_depth(const render::PinholeView& view, const render::Ground& ground, int x, int y) {
  const float fall = view.ray(x + 0.5, y + 0.5).dot(ground.up);
  return fall == 0 ? 0 : std::max(0.0F, ground.point_m.dot(ground.up) / fall);
}

}  // namespace

Hidden hidden_by(const Matte& matte, const render::Layers& layers, const render::PinholeView& part,
                 const std::optional<render::Ground>& ground, const PixelBox& box) {
  Hidden out{Image(box.width(), box.height(), 1), Image(box.width(), box.height(), 1)};
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x) {
      const float cover = std::clamp(matte.cover(box.left + x, box.top + y), 0.0F, 1.0F);
      if (cover == 0) continue;
      const float person = matte.depth_m(box.left + x, box.top + y);
      if (layers.depth(x, y) > person) out.model(x, y) = cover;
      if (ground && ground_depth(part, *ground, x, y) > person) out.ground(x, y) = cover;
    }
  }
  return out;
}

void composite(Image& picture, const PixelBox& box, const render::Layers& layers, const Hidden& hidden) {
  const bool any_hidden = !hidden.model.empty();
  for (int y = 0; y < box.height(); ++y) {
    for (int x = 0; x < box.width(); ++x) {
      const float model_share = any_hidden ? 1 - hidden.model(x, y) : 1;
      const float ground_share = any_hidden ? 1 - hidden.ground(x, y) : 1;
      const float cover = model_share * layers.object(x, y, 3);
      const float ground = layers.ground(x, y);
      float* pixel = picture.pixel(box.left + x, box.top + y);
      for (int c = 0; c < 3; ++c) {
        const float darker = ground * ground_share * (layers.shadow(x, y, c) - 1);
        pixel[c] = std::max(0.0F, model_share * layers.object(x, y, c) + (1 - cover + darker) * pixel[c]);
      }
    }
  }
}

}  // namespace faceprobe::insert
