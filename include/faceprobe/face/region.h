#pragma once
// The regions of core/region.h on the canonical face mesh, which has those up to kMouth.
//
//   const std::vector<Region> regions = triangle_regions(mesh);        // regions[t]: of mesh.triangles.row(t)

#include "faceprobe/core/region.h"
#include "faceprobe/face/canonical_mesh.h"

#include <vector>

namespace faceprobe::face {

// Region of each triangle of the canonical mesh, from landmark rings (eyes, lips, brows) and the canonical shape.
std::vector<Region> triangle_regions(const CanonicalMesh& mesh);

}  // namespace faceprobe::face
