#pragma once
// Internal: normal deviates for every pixel of a picture. Each is a function of its number and the key alone.

#include <cstddef>
#include <cstdint>

namespace faceprobe::synth {

// out[0 .. count - 1]: mean 0, variance 1, none beyond 5.9.
void fill_normals(float* out, std::size_t count, std::uint64_t key);

}  // namespace faceprobe::synth
