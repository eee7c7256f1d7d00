#pragma once
// The normals that a distant camera sees of a head mesh: one observation per pixel, nothing else. OBJ in, +z out of the face.

#include "faceprobe/lighting/observations.h"

#include <filesystem>

namespace faceprobe::bench {

// `long_side_px`: pixels over the face's height. Only vertices below `vertex_limit` (0 = all) belong to the face; faces that use
// others are left out. View along +z, no cast shadows. Throws Error(kInput).
lighting::Observations head_observations(const std::filesystem::path& obj, int long_side_px, int vertex_limit);

}  // namespace faceprobe::bench
