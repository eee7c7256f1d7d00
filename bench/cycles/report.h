#pragma once
// What the comparison with Cycles prints (Markdown on stdout) and draws.

#include "cycles/comparison.h"

namespace faceprobe::bench {

void print_errors(const Comparison& comparison, const ComparisonOptions& options);
void print_lamp(const Comparison& comparison);

// One PNG per map in the folder: ours, Cycles' and the difference (grey = none, black and white = a quarter of the mean), diffuse
// above specular.
void draw(const Comparison& comparison, const std::filesystem::path& folder);

// Times both at equal error; renders again.
void compare_speed(const Comparison& comparison, const ComparisonOptions& options);

}  // namespace faceprobe::bench
