#pragma once
// Where the networks run: the processor, or one NVIDIA card. Only for training networks and measuring them
// (torch_highlight_net.h, in builds with -DFACEPROBE_TRAIN=ON); everything else runs on the processor.
//
//   const net::Device device = net::device_from_name("auto");   // the first card if there is one, else the processor
//   std::cerr << net::device_name(device) << '\n';              // "cuda:0"

#include <string>
#include <string_view>

namespace faceprobe::net {

struct Device {
  bool cuda = false;
  int index = 0;  // which card; 0 for the processor

  bool operator==(const Device&) const = default;
};

// "auto", "cpu", "cuda" (the first card) or "cuda:N". Throws Error(kUsage) for any other name, Error(kDevice) for a card that
// is not there: a card that was asked for is never replaced by the processor.
Device device_from_name(std::string_view name);
// "cpu" or "cuda:N": what device_from_name reads.
std::string device_name(const Device& device);
// Throws Error(kDevice) when the device is not there.
void require_device(const Device& device);

}  // namespace faceprobe::net
