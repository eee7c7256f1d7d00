#pragma once
// The sizes of the light prior's network, shared by its training (torch/light_mlp.h) and its use (light_prior.cpp).

#include <string>
#include <vector>

namespace faceprobe::net {

struct LightOptions {
  int inputs = 0;
  std::vector<int> hidden = {384, 384};
  int outputs = 0;  // three numbers a cell: logarithms of radiance

  static constexpr float kSlope = 0.1F;    // of a unit below 0
  static constexpr float kLargestLog = 9;  // of radiance, either sign

  std::string validate() const;  // empty when usable
};

std::string options_json(const LightOptions& options);
// Throws Error(kModel).
LightOptions light_options_from_json(const std::string& json);

}  // namespace faceprobe::net
