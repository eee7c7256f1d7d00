#pragma once
// Networks that split a face's picture into albedo and shading, on libtorch, for measuring them beside face_net.h and for the paper's recolouring:
// the paper's Albedo-Shading network ("albedo_shading") and that of Shi et al. 2017 ("shi"). In builds with -DFACEPROBE_TRAIN=ON.
//
//   const net::TorchShadingNet network("albedo_shading.safetensors");
//   const net::ShadingLayers layers = network.layers(diffuse);   // the crop less its highlights

#include "faceprobe/core/image.h"
#include "faceprobe/net/device.h"
#include "faceprobe/net/model_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace faceprobe::net {

// Each at a level of its own: a picture does not tell which of the two is the brighter.
struct ShadingLayers {
  Image albedo, shading;  // H x W x 3 each, linear, finite, 0 or more
};

struct TorchShadingNetOptions {
  // Threads of the processor; 0 = all processors. As in torch_highlight_net.h, one number for the process.
  int threads = 0;
  Device device = {};

  std::string validate() const;
};

class TorchShadingNet {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network; Error(kDevice): the device is not there;
  // Error(kUsage): the options do not validate.
  explicit TorchShadingNet(const std::filesystem::path& weights, const TorchShadingNetOptions& options = {});
  TorchShadingNet(const TorchShadingNet&) = delete;
  TorchShadingNet& operator=(const TorchShadingNet&) = delete;
  TorchShadingNet(TorchShadingNet&&) noexcept;
  TorchShadingNet& operator=(TorchShadingNet&&) noexcept;
  ~TorchShadingNet();

  // What layers() is to be given: the diffuse layer, or else the photo as it is, whose highlights the network takes off by itself.
  bool takes_diffuse() const;
  // `picture`: H x W x 3, linear, of any size. The mean of what is seen in it and in its mirror image. Throws std::invalid_argument for another
  // number of channels.
  ShadingLayers layers(const Image& picture) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
