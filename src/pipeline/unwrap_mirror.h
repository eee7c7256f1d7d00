#pragma once
// What one half of a face lacks, from the other.

#include "faceprobe/core/image.h"
#include "faceprobe/synth/head_model.h"
#include "pipeline/unwrap_raster.h"

#include <vector>

namespace faceprobe::pipeline {

// Blends into `colour` and `weight` (texels) what the texels opposite know, where those here know less. Opposite on the neutral head
// (x -> -x), so the UVs need not be symmetric; vertices without a partner within 3 mm are left alone. `skin`: triangles to look at.
void add_mirrored(const synth::HeadModel& model, const std::vector<int>& skin, const MeshRaster& texels, Image& colour,
                  Image& weight);

}  // namespace faceprobe::pipeline
