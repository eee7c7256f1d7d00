#pragma once
// Internal: a Gaussian blur of one plane of a picture, row-major without gaps. Its kernel is the discrete Gaussian exp(-v) I_k(v)
// (Lindeberg 1990), whose variance is exactly the v that was asked for, however small. Edges are mirrored, so the sum is kept.

#include <vector>

namespace faceprobe::synth {

// Centre and one side of the kernel, its sum 1; what is cut off at the ends is under 1e-4. `deviation` is at most 24.
std::vector<float> gaussian_kernel(float deviation);

void blur_plane(float* plane, int width, int height, const std::vector<float>& kernel);

}  // namespace faceprobe::synth
