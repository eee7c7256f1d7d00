#pragma once
// Internal: how light each region's skin is beside the cheeks', told from shading. A beard's shadow on chin, jaw and upper lip is a darker
// albedo; taken for shading it is light from above.
//
//   luminance_i = relative(region_i) * (ambient + max(0, N_i . l)),    log relative(r) ~ N(mean_r, deviation_r)
//
// Maximum a posteriori by turns: the lamp and its surround by robust least squares (smooth_start.h), the regions in closed form.

#include "faceprobe/core/region.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace faceprobe::lighting {

// By region, from the first of the ten on; the cheeks' is 1.
using RelativeLuminance = std::array<float, kSkinRegionCount>;

struct RegionSamples {
  Eigen::MatrixX3f normal;     // #samples x 3, unit, camera frame
  Eigen::VectorXf luminance;   // #samples, linear
  std::vector<Region> region;  // of the ten
};

// What skins are like: ESTIMATES, medians over the albedo of synthetic faces of the training split, so of textures of 42 people.
RelativeLuminance usual_relative_luminance();
// The prior's where a region has too few samples that are lit.
RelativeLuminance fit_relative_luminance(const RegionSamples& samples);

}  // namespace faceprobe::lighting
