#pragma once
// The networks of highlight_net.h as training sees them, on libtorch: also the paper's MSCR and that of Shi et al. 2017, and on a card. For measuring what was
// trained; use highlight_net.h where only the layers are wanted. In builds with -DFACEPROBE_TRAIN=ON.
//
//   const net::TorchHighlightNet network("mscr.safetensors", {.device = net::device_from_name("auto")});
//   const Image highlight = network.highlight(crop, clip, mask);   // diffuse = crop - highlight

#include "faceprobe/core/image.h"
#include "faceprobe/net/device.h"
#include "faceprobe/net/model_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace faceprobe::net {

struct TorchHighlightNetOptions {
  // Threads of the processor; 0 = all processors. libtorch has one such number per process: the network that was made last
  // sets it for all. The last bits of a result may depend on it.
  int threads = 0;
  Device device = {};

  std::string validate() const;
};

class TorchHighlightNet {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network; Error(kDevice): the device is not there;
  // Error(kUsage): the options do not validate.
  explicit TorchHighlightNet(const std::filesystem::path& weights, const TorchHighlightNetOptions& options = {});
  TorchHighlightNet(const TorchHighlightNet&) = delete;
  TorchHighlightNet& operator=(const TorchHighlightNet&) = delete;
  TorchHighlightNet(TorchHighlightNet&&) noexcept;
  TorchHighlightNet& operator=(TorchHighlightNet&&) noexcept;
  ~TorchHighlightNet();

  // As HighlightNet::highlight.
  Image highlight(const Image& linear, const ByteImage& clip, const ByteImage& mask) const;

  const ModelInfo& info() const;  // what the weights file says of itself
  const Device& device() const;   // where it runs

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
