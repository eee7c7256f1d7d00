#pragma once
// Rows of light by networks that others have thought of, trained on what we have (docs/training.md): of the scene behind the head, or of the face
// without any model of light.

#include "face_light_methods.h"
#include "faceprobe/eval/relight_benchmark.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct RivalRows {
  std::filesystem::path weights;  // folder: gardner.safetensors, sky.safetensors, legendre.safetensors
  std::filesystem::path maps;     // folder of the HDR maps that the data was lit by
  std::string recipe;             // ShardReader::recipe() of the data
  int threads = 0;
};
struct RivalMethods {
  std::vector<eval::LightMethod> methods;
  std::string missing;  // sentences: which rows are not there and why; empty when all are
};
// The networks of backgrounds see 60 degrees of the map straight behind the head, as sharp as the map is and without the head before it: more
// than a photo would show them. They see it level; the photos' cameras tilt by some degrees. Throws Error(kModel), Error(kInput).
RivalMethods rival_light_methods(const RivalRows& rows);

// The one of these networks that sees the face, on any photo: where the estimate has skin, eyes or mouth is its face. Nothing, and a sentence more
// in `missing`, where the folder lacks its weights. Throws Error(kModel).
std::optional<FaceLightMethod> face_network_method(const std::filesystem::path& weights, std::string& missing);

}  // namespace faceprobe::cli
