#pragma once
// Re-blurring (Zhuo & Sim 2011, "Defocus map estimation from a single image", Pattern Recognition 44): a step that went through a
// Gaussian of variance s has a gradient of height 1 / sqrt(s), so blurred further to variances v1 and v2 its heights have the
// ratio R with R^2 = (s + v2) / (s + v1). A third blur tells steps from lines and texture, whose figures do not agree.
//
//   const Gradients gradients = blurred_gradients(luminance);
//   if (const auto variance = step_variance(gradients, x, y)) ...      // (x, y) on the ridge of gradients[1].size

#include "faceprobe/core/image.h"

#include <array>
#include <optional>

namespace faceprobe::insert {

struct Gradient {
  Image across, down, size;
};

using Gradients = std::array<Gradient, 3>;  // from the least blurred on

// One channel; 0 in the outermost pixels.
Gradients blurred_gradients(const Image& luminance);

// To the neighbour across the edge.
struct Step {
  int x = 1, y = 0;
};
Step across_edge(const Gradient& gradient, int x, int y);

// What the step at a ridge pixel went through, a little below 0 at times; none where it is no step. The pixel and its neighbours
// must be inside.
std::optional<double> step_variance(const Gradients& gradients, int x, int y);

}  // namespace faceprobe::insert
