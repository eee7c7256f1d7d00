#pragma once
// Cycles' picture of a MakeHuman head as a sample of the kind that `faceprobe synth` writes.

#include "faceprobe/face/face.h"
#include "faceprobe/synth/shard.h"

#include <filesystem>
#include <optional>

namespace faceprobe::bench {

// The highlight is what the glossy lobe mirrors, the diffuse layer the rest of the picture; the photo is taken by a camera drawn like
// those of the training faces, {seed, number} being its key. Regions: kCheeks where skin lies inside the hull of the landmarks that the
// face finder sees in the photo, kOther on other skin, kNone elsewhere. No shading, depth and environment. Empty when no face is found.
std::optional<synth::ViewSamples> convert(const std::filesystem::path& picture, const face::FaceFinder& finder,
                                          std::uint64_t seed, int number);

}  // namespace faceprobe::bench
