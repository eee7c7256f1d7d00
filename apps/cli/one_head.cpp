#include "one_head.h"

#include "faceprobe/assets/heads.h"
#include "faceprobe/core/error.h"
#include "faceprobe/pipeline/head_geometry.h"

#include <utility>
#include <vector>

namespace faceprobe::cli {

synth::HeadModel load_one_head(const std::string& path) {
  std::vector<synth::HeadModel> models = assets::load_heads(path);
  if (models.size() != 1) {
    throw Error(ExitCode::kUsage, path + " holds " + std::to_string(models.size()) +
                                      " head models; one is fitted to a face. Name its folder or file.");
  }
  return std::move(models.front());
}

face::SurfaceFit surface_of_head(const std::string& path, int threads) {
  return pipeline::head_geometry(load_one_head(path), face::FaceFinder({.threads = threads}), threads);
}

}  // namespace faceprobe::cli
