#pragma once
// The contract all metrics share.

#include "faceprobe/core/image.h"

#include <stdexcept>
#include <string>

namespace faceprobe::eval {

// Throws std::invalid_argument, naming `metric`, unless the pictures are of one size and the mask fits them.
inline void check_pictures(const char* metric, const Image& estimate, const Image& truth, const ByteImage& mask) {
  const auto refuse = [&](const char* what) { throw std::invalid_argument(std::string(metric) + ": " + what); };
  if (!estimate.same_size(truth)) refuse("the pictures differ in size");
  if (estimate.channels() != truth.channels()) refuse("the pictures differ in their number of channels");
  if (!mask.empty() && (!mask.same_size(truth) || mask.channels() != 1)) {
    refuse("the mask must have one channel and the size of the pictures");
  }
}

}  // namespace faceprobe::eval
