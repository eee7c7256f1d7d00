#include "net/fixtures.h"

#include "faceprobe/net/model_file.h"
#include "net/torch/mscr.h"
#include "net/torch/weights.h"

#include <random>

namespace faceprobe::net::testing {

namespace {

// Tests run side by side, each a process; threads that wait for one another by spinning would only slow them down.
class OneThread : public ::testing::Environment {
 public:
  void SetUp() override { torch::set_num_threads(1); }
};
[[maybe_unused]] const ::testing::Environment* const kOneThread = ::testing::AddGlobalTestEnvironment(new OneThread);

}  // namespace

UNetOptions small_options() { return {.widths = {8, 16, 16}, .convs_per_level = 2}; }

std::map<std::string, std::string> unet_metadata(const UNetOptions& options) {
  return {{kArchitectureKey, kUNetArchitecture}, {kOptionsKey, options_json(options)}};
}

void write_unet(const std::filesystem::path& path, const UNetOptions& options, bool half) {
  torch::manual_seed(1);
  save_weights(*UNet(options), path, unet_metadata(options), half);
}

void write_mscr(const std::filesystem::path& path) {
  torch::manual_seed(1);
  Mscr net(MscrOptions{});
  const torch::NoGradGuard no_grad;
  net->named_parameters()["up.weight"].mul_(100);  // as filled its output is within 0.01 of nothing
  save_weights(*net, path, {{kArchitectureKey, kMscrArchitecture}, {kOptionsKey, options_json(MscrOptions{})}}, false);
}

Image random_picture(int width, int height, float low, float high) {
  std::mt19937 engine(7);
  Image picture(width, height, 3);
  for (float& value : picture.values()) {
    value = low + (high - low) * static_cast<float>(engine()) / static_cast<float>(std::mt19937::max());
  }
  return picture;
}

}  // namespace faceprobe::net::testing
