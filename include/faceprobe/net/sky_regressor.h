#pragma once
// The light of an outdoor scene from a part of a photo of it, without any face: a rival to measure Faceprobe against, after Hold-Geoffroy et
// al. 2017 ("Deep outdoor illumination estimation", CVPR, arXiv 1611.06403). A small network says where the sun stands, as shares of 160 bins,
// and a few numbers of sky and camera; the light is the sky model drawn from them. Tables call it "hold-geoffroy, preetham sky": the model is
// that of Preetham et al. where theirs is that of Hosek and Wilkie, whose tables are too large to carry, so that low suns and haze come out less
// true. Theirs has also seen thousands of panoramas, and larger pictures; how strong the sun shines is a number of its own here. In builds with
// -DFACEPROBE_TRAIN=ON.
//
//   const net::SkyRegressor network("sky.safetensors");            // `faceprobe train sky` writes it
//   const Eigen::MatrixX3f light = network.light(background);      // SphereGrid(16), camera frame
//
// Not for rooms and not for the night: it always answers with a day's sky.

#include "faceprobe/core/image.h"
#include "faceprobe/core/sky.h"
#include "faceprobe/net/model_file.h"

#include <Eigen/Core>
#include <filesystem>
#include <memory>

namespace faceprobe::net {

inline constexpr const char* kSkyArchitecture = "sky";

struct SkyEstimate {
  // In the frame of a camera held level: +x to the right, +y the world's up, the camera looks towards -z. 1 is the picture's white.
  SkyParameters sky;
  double camera_elevation_rad = 0;  // positive where the camera looks up
  double field_of_view_rad = 0;     // of the picture's width; light() has no use for it
  Eigen::VectorXf sun_share;        // of core/sun_bins.h, sum 1
};

class SkyRegressor {
 public:
  static constexpr int kLightNside = 16;

  // Throws Error(kModel): the file is not there, damaged, or of another network. `threads` of the processor, 0 = all; libtorch has one such
  // number per process.
  explicit SkyRegressor(const std::filesystem::path& weights, int threads = 0);
  SkyRegressor(const SkyRegressor&) = delete;
  SkyRegressor& operator=(const SkyRegressor&) = delete;
  SkyRegressor(SkyRegressor&&) noexcept;
  SkyRegressor& operator=(SkyRegressor&&) noexcept;
  ~SkyRegressor();

  // `linear_crop`: square with three channels, linear, clipped at 1 as a camera does; of any size, it is brought to the network's. The sun is
  // the middle of the most likely bin and its neighbours. Throws std::invalid_argument: another shape, numbers that are none.
  SkyEstimate estimate(const Image& linear_crop) const;
  // Cells of SphereGrid(kLightNside) x 3, camera frame, on the crop's scale.
  Eigen::MatrixX3f light(const Image& linear_crop) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The rotation that takes a direction of the camera frame to that of a camera held level.
Eigen::Matrix3f level_from_camera(double camera_elevation_rad);
// The middle of the most likely bin and its neighbours. `share`: kSunBins numbers, 0 or more. Throws std::invalid_argument for another number.
Eigen::Vector3d sun_of_shares(const Eigen::VectorXf& share);

}  // namespace faceprobe::net
