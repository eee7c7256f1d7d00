#include "shading_split.h"

#include "faceprobe/core/error.h"
#include "faceprobe/net/torch_shading_net.h"

#include <memory>

namespace faceprobe::cli {

pipeline::ShadingSplit split_by_weights(const std::string& path, int threads) {
  const auto network = std::make_shared<net::TorchShadingNet>(path, net::TorchShadingNetOptions{.threads = threads});
  if (!network->takes_diffuse()) {
    throw Error(ExitCode::kModel, path + " holds the network \"" + network->info().architecture +
                                      "\", which wants the photo with its highlights; --shading-weights takes "
                                      "albedo_shading, which wants the diffuse layer.");
  }
  return [network](const Image& diffuse) { return network->layers(diffuse).shading; };
}

}  // namespace faceprobe::cli
