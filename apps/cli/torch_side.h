#pragma once
// What of the command needs libtorch: training, and the networks that only training runs. It is a module, loaded when something is first asked of
// it, because loading libtorch takes longer than most of what the command does. A lean build, which does little but train, has it in the program.
//
//   const train::LightReport report = torch_side().train_light(run, progress);
//
// Each entry throws what the function or class that it is named after throws.

#include "faceprobe/net/device.h"
#include "faceprobe/train/train.h"
#include "faceprobe/train/train_light.h"
#ifndef FACEPROBE_LEAN
#include "faceprobe/net/torch_highlight_net.h"
#include "faceprobe/net/torch_shading_net.h"
#include "faceprobe/train/finetune.h"
#include "faceprobe/train/finetune_surface.h"
#include "faceprobe/train/train_regressor.h"
#include "faceprobe/train/train_sky.h"
#endif

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace faceprobe::cli {

// The mean of both ways (net/both_ways.h).
using HighlightLayer = std::function<Image(const Image& linear, const ByteImage& clip, const ByteImage& mask)>;
// Cells of SphereGrid(16) x 3, of a square picture.
using PictureLight = std::function<Eigen::MatrixX3f(const Image& linear_crop)>;
struct SizedPictureLight {
  int picture_px = 0;  // side of the pictures that it was trained on
  PictureLight light;
};
#ifndef FACEPROBE_LEAN
struct PictureSplit {
  std::string architecture;
  bool takes_diffuse = false;  // or else the photo with its highlights
  std::function<net::ShadingLayers(const Image& picture)> layers;
};
#endif

struct TorchSide {
  net::Device (*device_from_name)(std::string_view name);
  train::TrainReport (*train_highlight)(const train::TrainRun&, const train::TrainHooks&);
  train::LightReport (*train_light)(const train::LightRun&, const std::function<void(const train::LightRow&, int)>&);
#ifndef FACEPROBE_LEAN
  train::FinetuneReport (*finetune_highlight)(const train::FinetuneRun&, const train::FinetuneHooks&);
  train::FinetuneSurfaceReport (*finetune_surface)(const train::FinetuneSurfaceRun&, const train::FinetuneSurfaceHooks&);
  train::RegressorReport (*train_gardner)(const train::GardnerData&, const train::RegressorRun&,
                                          const train::RegressorProgress&);
  train::RegressorReport (*train_legendre)(const train::LegendreData&, const train::RegressorRun&,
                                           const train::RegressorProgress&);
  train::SkyReport (*train_sky)(const train::SkyRun&, const std::function<void(const train::SkyRow&, int)>&);
  HighlightLayer (*highlight_net)(const std::filesystem::path& weights, const net::TorchHighlightNetOptions&);
  PictureSplit (*shading_net)(const std::filesystem::path& weights, const net::TorchShadingNetOptions&);
  SizedPictureLight (*light_regressor)(const std::filesystem::path& weights);
  PictureLight (*sky_regressor)(const std::filesystem::path& weights, int threads);
#endif
};

// Throws Error(kDevice) when the module, or libtorch, cannot be loaded.
const TorchSide& torch_side();
#ifndef FACEPROBE_LEAN
// The module, whether it is there or not.
std::filesystem::path torch_side_file();
#endif

// What the module is asked for.
extern "C" __attribute__((visibility("default"))) const TorchSide* faceprobe_torch_side();

}  // namespace faceprobe::cli
