#pragma once
// What bench_insert_cycles prints: Markdown on stdout.

#include "insert_cycles/comparison.h"

#include <vector>

namespace faceprobe::bench {

void print_same_picture(const std::vector<Case>& cases, const InsertOptions& options);
void print_time(const std::vector<Case>& cases, const InsertOptions& options);

}  // namespace faceprobe::bench
