#include "shading_split.h"

#include "faceprobe/core/error.h"
#include "torch_side.h"

#include <utility>

namespace faceprobe::cli {

pipeline::ShadingSplit split_by_weights(const std::string& path, int threads) {
  PictureSplit network = torch_side().shading_net(path, {.threads = threads});
  if (!network.takes_diffuse) {
    throw Error(ExitCode::kModel, path + " holds the network \"" + network.architecture +
                                      "\", which wants the photo with its highlights; --shading-weights takes "
                                      "albedo_shading, which wants the diffuse layer.");
  }
  return [layers = std::move(network.layers)](const Image& diffuse) { return layers(diffuse).shading; };
}

}  // namespace faceprobe::cli
