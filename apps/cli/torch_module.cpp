// The module that torch_side.h describes: nothing else of the command is linked with libtorch. It does not log; what is to be said goes through the
// hooks that it is given.

#include "torch_side.h"
#ifndef FACEPROBE_LEAN
#include "faceprobe/net/both_ways.h"
#include "faceprobe/net/light_regressor.h"
#include "faceprobe/net/sky_regressor.h"
#endif

#include <memory>

namespace faceprobe::cli {

#ifndef FACEPROBE_LEAN
namespace {

HighlightLayer highlight_net(const std::filesystem::path& weights, const net::TorchHighlightNetOptions& options) {
  return [net = std::make_shared<net::TorchHighlightNet>(weights, options)](const Image& linear, const ByteImage& clip,
                                                                            const ByteImage& mask) {
    return net::highlight_both_ways(*net, linear, clip, mask);
  };
}

PictureSplit shading_net(const std::filesystem::path& weights, const net::TorchShadingNetOptions& options) {
  const auto net = std::make_shared<net::TorchShadingNet>(weights, options);
  return {net->info().architecture, net->takes_diffuse(), [net](const Image& picture) { return net->layers(picture); }};
}

SizedPictureLight light_regressor(const std::filesystem::path& weights) {
  const auto net = std::make_shared<net::LightRegressor>(weights);
  return {net->picture_px(), [net](const Image& linear_crop) { return net->light(linear_crop); }};
}

PictureLight sky_regressor(const std::filesystem::path& weights, int threads) {
  return [net = std::make_shared<net::SkyRegressor>(weights, threads)](const Image& linear_crop) {
    return net->light(linear_crop);
  };
}

}  // namespace
#endif

extern "C" const TorchSide* faceprobe_torch_side() {
  static constexpr TorchSide kSide = {
      .device_from_name = net::device_from_name,
      .train_highlight = train::train_highlight,
      .train_light = train::train_light,
#ifndef FACEPROBE_LEAN
      .finetune_highlight = train::finetune_highlight,
      .finetune_surface = train::finetune_surface,
      .train_gardner = train::train_gardner,
      .train_legendre = train::train_legendre,
      .train_sky = train::train_sky,
      .highlight_net = highlight_net,
      .shading_net = shading_net,
      .light_regressor = light_regressor,
      .sky_regressor = sky_regressor,
#endif
  };
  return &kSide;
}

}  // namespace faceprobe::cli
