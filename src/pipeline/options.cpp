#include "faceprobe/pipeline/estimate.h"

namespace faceprobe::pipeline {

std::string EstimateOptions::validate() const {
  for (const std::string& fault : {finder.validate(), solve.validate(), main_lights.validate()}) {
    if (!fault.empty()) return fault;
  }
  if (focal_px && !(*focal_px > 1.0)) return "focal_px must be more than 1 pixel, found " + std::to_string(*focal_px) + ".";
  if (layer_px < 64 || layer_px > 8192) return "layer_px must be from 64 to 8192, found " + std::to_string(layer_px) + ".";
  if (max_patches < 50 || max_patches > 20'000) {
    return "max_patches must be from 50 to 20000, found " + std::to_string(max_patches) + ".";
  }
  if (map_width < 16 || map_width > 4096 || map_width % 4 != 0) {
    return "The map's width must be a multiple of 4 from 16 to 4096, found " + std::to_string(map_width) + ".";
  }
  if (sh_order < 0 || sh_order > 10) return "sh_order must be from 0 to 10, found " + std::to_string(sh_order) + ".";
  if (landmarks_px && landmarks_px->rows() != 5 && landmarks_px->rows() != 68) {
    return "Give 5 or 68 landmarks, found " + std::to_string(landmarks_px->rows()) + ".";
  }
  return {};
}

}  // namespace faceprobe::pipeline
