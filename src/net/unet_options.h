#pragma once
// Shape of the small network of the highlight separation (unet_runner.h runs it, torch/unet.h trains it), as its weights file names it.

#include <string>
#include <vector>

namespace faceprobe::net {

struct UNetOptions {
  int in_channels = 7;
  int out_channels = 4;
  std::vector<int> widths = {32, 64, 96, 128, 160};
  int convs_per_level = 2;  // 3x3 convolutions of a level on either side, its change of size included

  std::string validate() const;
  int multiple() const { return 1 << widths.size(); }  // of which height and width of its input must be multiples
  bool operator==(const UNetOptions&) const = default;
};
std::string options_json(const UNetOptions& options);
// Throws Error(kModel).
UNetOptions unet_options_from_json(const std::string& text);

constexpr int kFold = 2;             // pixels of a side that become channels
constexpr int kNormGroups = 8;       // of the group norm
constexpr float kNormFloor = 1e-5F;  // added to the variance

}  // namespace faceprobe::net
