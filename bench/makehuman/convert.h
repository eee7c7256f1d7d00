#pragma once
// Cycles' picture of a MakeHuman head as a sample of the kind that `faceprobe synth` writes.

#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"
#include "faceprobe/synth/shard.h"

#include <filesystem>
#include <optional>

namespace faceprobe::bench {

// The highlight is what the glossy lobe mirrors, the diffuse layer the rest of the picture; the photo is taken by a camera drawn like
// those of the training faces, {seed, number} being its key; where it stood is in the file of the picture's name that ends in .json.
// Regions: on skin inside the hull of the landmarks that the face finder sees in the photo those of its mesh, kCheeks where that has none;
// kOther on other skin, kNone elsewhere. Shading: what the diffuse layer is to its colour. No depth and environment. Empty when no face is
// found.
std::optional<synth::ViewSamples> convert(const std::filesystem::path& picture, const face::FaceFinder& finder,
                                          const face::CanonicalMesh& mesh, std::uint64_t seed, int number);

}  // namespace faceprobe::bench
