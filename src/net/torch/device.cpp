#include "faceprobe/net/device.h"

#include "faceprobe/core/error.h"

#include <torch/torch.h>
#include <charconv>

namespace faceprobe::net {
namespace {

constexpr std::string_view kCuda = "cuda";

int card_count() { return torch::cuda::is_available() ? static_cast<int>(torch::cuda::device_count()) : 0; }

[[noreturn]] void refuse_name(std::string_view name) {
  throw Error(ExitCode::kUsage,
              "There is no device \"" + std::string(name) + "\"; choose auto, cpu, cuda or cuda:N with N = 0, 1, ...");
}

// The N of "cuda:N".
int card_index(std::string_view name) {
  const std::string_view digits = name.substr(kCuda.size() + 1);
  int index = 0;
  const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  if (problem != std::errc() || end != digits.data() + digits.size() || index < 0) refuse_name(name);
  return index;
}

}  // namespace

Device device_from_name(std::string_view name) {
  if (name == "cpu") return {};
  if (name == "auto") return {.cuda = card_count() > 0, .index = 0};
  if (name != kCuda && !name.starts_with("cuda:")) refuse_name(name);
  const Device device{.cuda = true, .index = name == kCuda ? 0 : card_index(name)};
  require_device(device);
  return device;
}

std::string device_name(const Device& device) {
  return device.cuda ? std::string(kCuda) + ":" + std::to_string(device.index) : "cpu";
}

void require_device(const Device& device) {
  if (!device.cuda) return;
  const int count = card_count();
  if (device.index >= 0 && device.index < count) return;
  throw Error(ExitCode::kDevice, "The device " + device_name(device) + " is not there: " +
                                     (count == 0 ? "this build of libtorch sees no CUDA card"
                                                 : std::to_string(count) + " CUDA card(s) found") +
                                     ". Choose cpu or auto" + (count == 0 ? "." : ", or a lower number."));
}

}  // namespace faceprobe::net
