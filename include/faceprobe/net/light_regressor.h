#pragma once
// Two rivals that regress light straight from a picture, built after what is published of them, small, and trained on little data: to be
// measured against, not to be used. Their weights say which one they are.
//
// "gardner": Gardner et al. 2017, "Learning to predict indoor illumination from a single image". Sees a part of a scene's background and
// says the panorama around the camera, by one head its colours and by another its lights.
// "legendre": LeGendre et al. 2020, "Learning illumination from diverse portraits", without its adversary. Sees a face's crop (face_window.h).
//
// For light by what a face's pixels say, see pipeline/estimate.h. In builds with -DFACEPROBE_TRAIN=ON.
//
//   const net::LightRegressor rival("legendre.safetensors");
//   const std::optional<Window> window = net::face_window(mask, rival.picture_px());
//   if (window) light = rival.light(resampled(linear, *window, Outside::kEdge));   // cells of SphereGrid(16) x 3

#include "faceprobe/core/image.h"
#include "faceprobe/net/model_file.h"

#include <Eigen/Core>
#include <filesystem>
#include <memory>

namespace faceprobe::net {

inline constexpr const char* kGardnerArchitecture = "gardner";
inline constexpr const char* kLegendreArchitecture = "legendre";

class LightRegressor {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network.
  explicit LightRegressor(const std::filesystem::path& weights);
  LightRegressor(const LightRegressor&) = delete;
  LightRegressor& operator=(const LightRegressor&) = delete;
  LightRegressor(LightRegressor&&) noexcept;
  LightRegressor& operator=(LightRegressor&&) noexcept;
  ~LightRegressor();

  static constexpr int kNside = 16;  // of the grid that light() fills
  int picture_px() const;            // side of the pictures that it was trained on

  // #cells of SphereGrid(kNside) x 3, > 0, camera frame: radiance on the crop's scale, where 1 is its white. `linear_crop`: square with three
  // channels, of any size; throws std::invalid_argument for another.
  Eigen::MatrixX3f light(const Image& linear_crop) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
